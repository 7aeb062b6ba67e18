#pragma once
#include <stdint.h>

namespace firmtouch::core {

enum class CrashCause : uint32_t {
  kReset,          // none was noted: a pin or a debugger
  kFault,          // HardFault, or an exception of RISC-V
  kStackOverflow,  // found by the guard below the stack
  kWatchdog,       // its warning, before it resets, or what the chip says of the reset
};

constexpr uint32_t kCrashTicks = 8;

struct CrashTick {
  uint32_t tick, clock_us;  // of record::TickInput
  uint32_t state, faults;   // of record::TickOutput
};

/// What a run left that a fault, the watchdog or a reset ended (hal/crash_record.hpp).
struct CrashRecord {
  CrashCause cause = CrashCause::kReset;
  uint32_t pc = 0, link = 0, status = 0;  // link register; 0: not known
  uint32_t ticks = 0;                     // entries of `last`
  CrashTick last[kCrashTicks] = {};       // oldest first; damaged ones are left out
};
static_assert(sizeof(CrashRecord) == 148);

}  // namespace firmtouch::core
