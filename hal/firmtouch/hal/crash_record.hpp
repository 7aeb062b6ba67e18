#pragma once
#include "firmtouch/core/crash_record.hpp"

// What a crash leaves behind: the cause and the last ticks, in memory that start-up does not touch,
// each entry with a check value. A part that only its users link: PARTS firmtouch_crash_record.
namespace firmtouch::hal {

using core::CrashCause;
using core::CrashRecord;
using core::CrashTick;
using core::kCrashTicks;

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
