#pragma once
#include <stdint.h>

// What a crash leaves behind: the cause and the last ticks, in memory that start-up does not touch,
// each entry with a check value. A part that only its users link: PARTS firmtouch_crash_record.
namespace firmtouch::hal {

enum class CrashCause : uint32_t {
  kReset,          // none was noted: a pin, a debugger, or a watchdog without a warning
  kFault,          // HardFault, or an exception of RISC-V
  kStackOverflow,  // found by the guard below the stack
  kWatchdog,       // its warning, before it resets
};

constexpr uint32_t kCrashTicks = 8;

struct CrashTick {
  uint32_t tick, clock_us;  // of record::TickInput
  uint32_t state, faults;   // of record::TickOutput
};

struct CrashRecord {
  CrashCause cause = CrashCause::kReset;
  uint32_t pc = 0, link = 0, status = 0;  // link register; 0: not known
  uint32_t ticks = 0;                     // entries of `last`
  CrashTick last[kCrashTicks] = {};       // oldest first; damaged ones are left out
};

/// What the run before this one left, and makes room for this one's.
/// Result: false if nothing was left: first power-up, or memory that lost its contents.
/// Context: start-up, before clock_start_servo().
bool crash_take(CrashRecord& record);

/// Prints a record to the console.
/// Context: start-up.
void crash_print(const CrashRecord& record);

/// Keeps a tick until a later one takes its place.
/// Context: servo interrupt, at the end of a tick.
void crash_keep_tick(const CrashTick& tick);

}  // namespace firmtouch::hal
