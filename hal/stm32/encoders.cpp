#include "firmtouch/hal/encoders.hpp"

#include "registers.hpp"

// Timers 2, 3 and 4 count both edges of both channels of an encoder. Two of them have 16 bits: of
// each the difference of a tick is added up, which is right below 32,768 counts a tick.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kBothEdges = 3;                                   // slave mode
constexpr uint32_t kFilter = 0x3;                                    // eight cycles of the timer
constexpr uint32_t kInputs = 0x0101 | kFilter << 4 | kFilter << 12;  // channels 1 and 2, filtered

uint32_t g_count[3];
uint16_t g_last[3];

}  // namespace

void encoders_begin() {
  for (const Pin& pin : kEncoderPins) pin_alternate(pin, Pull::kUp);
  for (const uint32_t timer : kEncoderTimers) {
    reg(timer + kTimerReload) = 0xFFFF;
    reg(timer + kTimerChannels) = kInputs;
    reg(timer + kTimerMode) = kBothEdges;
    reg(timer + kTimerCount) = 0;
    reg(timer + kTimerControl) = kTimerOn;
  }
}

bool encoders_read(int32_t (&counts)[3]) {
  uint16_t now[3];
  bool is_counting = true;
  {
    const CriticalSection alone;  // at one instant
    for (uint32_t i = 0; i < 3; ++i)
      now[i] = static_cast<uint16_t>(reg(kEncoderTimers[i] + kTimerCount));
  }
  for (uint32_t i = 0; i < 3; ++i) {
    is_counting &= (reg(kEncoderTimers[i] + kTimerControl) & kTimerOn) != 0;
    const int16_t moved = static_cast<int16_t>(static_cast<uint16_t>(now[i] - g_last[i]));
    g_count[i] += static_cast<uint32_t>(static_cast<int32_t>(moved));
    g_last[i] = now[i];
    counts[i] = static_cast<int32_t>(g_count[i]);
  }
  return is_counting;
}

}  // namespace firmtouch::hal
