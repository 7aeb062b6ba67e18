#include "firmtouch/hal/pace.hpp"

#include "emulator/semihosting.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kTicksPerByte = 20;
constexpr uint32_t kReadText = 0;

}  // namespace

// The emulator's standard input is the clock: one byte releases 20 ticks. After its end, or without
// an input, the call never waits.
void pace_tick() {
  static int32_t clock = -1;
  static uint32_t tick = 0;
  static bool has_ended = false;
  if (has_ended || tick++ % kTicksPerByte != 0) return;
  if (tick == 1) clock = semihosting_open(":tt", kReadText);
  uint8_t byte[1];
  has_ended = clock < 0 || semihosting_read(clock, byte, 1) != 1;
}

}  // namespace firmtouch::hal
