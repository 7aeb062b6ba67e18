// Causes the fault that the emulator's command line names; tests/target/run_faults checks the
// reaction.
#include <stdint.h>

#include "cortex-m/semihosting.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"

namespace {

using firmtouch::hal::board_print;

[[gnu::noinline]] uint32_t fall(uint32_t depth) {
  volatile uint32_t room[64];
  room[depth % 64] = depth;
  const uint32_t below = depth == UINT32_MAX ? 0 : fall(depth + 1);
  return room[below % 64];  // used after the call, so that it cannot become a loop
}

bool wants(const char* line, const char* word) {
  while (*word != 0 && *line == *word) ++line, ++word;
  return *word == 0;
}

}  // namespace

/// Replaces the board's motors: prints when they are switched off.
namespace firmtouch::hal {
void motors_off() { board_print("motors off\n"); }
}  // namespace firmtouch::hal

int main() {
  firmtouch::hal::board_begin();
  board_print("running\n");
  char line[64];
  if (!firmtouch::hal::semihosting_command_line(line, sizeof line)) return 2;
  if (wants(line, "bus"))
    return static_cast<int>(*reinterpret_cast<volatile uint32_t*>(uintptr_t{0x90000000}));
  if (wants(line, "undefined")) asm volatile("udf #1");
  if (wants(line, "overflow")) return static_cast<int>(fall(0));
  if (wants(line, "watchdog")) {
    firmtouch::hal::watchdog_begin(1000);
    for (;;) asm volatile("nop");
  }
  if (wants(line, "exit")) return 42;
  return 2;
}
