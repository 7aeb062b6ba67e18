#include "cortex-m/fault.hpp"
#include "crash_record/kept.hpp"
#include "firmtouch/hal/motors.hpp"

namespace firmtouch::hal {

/// Replaces fault.cpp's, which is weak.
extern "C" [[gnu::used]] void hard_fault(const Frame* frame) {
  motors_off();
  constexpr uint32_t kNmi = 2;
  uint32_t exception;
  asm volatile("mrs %0, ipsr" : "=r"(exception));
  const uint32_t status = reg(kFaultStatus);
  if (frame == nullptr)
    crash_keep_cause(CrashCause::kStackOverflow, 0, 0, status);
  else
    crash_keep_cause(exception == kNmi ? CrashCause::kWatchdog : CrashCause::kFault, frame->pc,
                     frame->lr, status);
  report_fault(frame);
}

}  // namespace firmtouch::hal
