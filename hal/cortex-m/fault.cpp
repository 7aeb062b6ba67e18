#include "cortex-m/fault.hpp"

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "parts/fault_text.hpp"

// HardFault and NMI: motors off first, then a report, then stop.

namespace firmtouch::hal {
extern "C" {

void report_fault(const Frame* frame) {
  motors_off();
  board_print("\nFault: motors are off. ");
  print_hex("status ", reg(kFaultStatus));
  if (frame != nullptr) {
    print_hex("pc ", frame->pc);
    print_hex("lr ", frame->lr);
    board_print("see addr2line\n");
  } else {
    board_print(kStackOverflowText);
  }
  board_exit(kFaultExitStatus);
}

/// What the handler calls. Part firmtouch_crash_record replaces it.
[[gnu::used, gnu::weak, gnu::alias("report_fault")]] void hard_fault(const Frame* frame);

// The frame is on the stack that was in use: bit 2 of the return code in lr names it. At or below
// its limit the main stack has overflowed, and this handler begins a new one.
[[gnu::naked]] void hard_fault_handler() {
  asm volatile(
      "mrs r0, msp             \n"
      "ldr r1, =__stack_bottom \n"
      "cmp r0, r1              \n"
      "bhi 1f                  \n"
      "ldr r1, =__stack_top    \n"
      "mov sp, r1              \n"
      "movs r0, #0             \n"
      "b hard_fault            \n"
      "1: tst lr, #4           \n"
      "it ne                   \n"
      "mrsne r0, psp           \n"
      "b hard_fault            \n"
      ".ltorg                  \n");  // the two addresses, within reach
}

}  // extern "C"
}  // namespace firmtouch::hal
