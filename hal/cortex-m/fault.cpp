#include <stdint.h>

#include "cortex-m/cortex_m.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "parts/fault_text.hpp"

// HardFault and NMI: motors off first, then a report, then stop.

namespace firmtouch::hal {
namespace {

struct Frame {  // pushed by the core (ARM DDI 0403, B1.5.6)
  uint32_t r[4], r12, lr, pc, status;
};

}  // namespace

extern "C" {

/// `frame` is null after a stack overflow.
[[gnu::used]] void hard_fault(const Frame* frame) {
  motors_off();
  board_print("\nFault: motors are off. ");
  print_hex("status ", reg(kFaultStatus));
  if (frame != nullptr) {
    print_hex("pc ", frame->pc);
    print_hex("lr ", frame->lr);
    board_print("(find them with addr2line)\n");
  } else {
    board_print(kStackOverflowText);
  }
  board_exit(kFaultExitStatus);
}

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
