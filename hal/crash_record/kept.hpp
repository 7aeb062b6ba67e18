#pragma once
#include <stdint.h>

#include "firmtouch/hal/crash_record.hpp"

namespace firmtouch::hal {

/// Four words that survive a reset, and their check value. One that was torn or flipped, or is what
/// RAM holds at power-up, does not match.
struct Kept {
  uint32_t words[4];
  uint32_t check;

  void set(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
  bool is_whole() const;
};

extern Kept g_crash_cause, g_crash_ticks[kCrashTicks];

/// From a fault handler, behind motors_off(). The first of a run counts: a watchdog that ends the
/// stop behind a fault is not the cause.
void crash_keep_cause(CrashCause cause, uint32_t pc, uint32_t link, uint32_t status);

}  // namespace firmtouch::hal
