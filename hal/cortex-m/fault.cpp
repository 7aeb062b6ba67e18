#include <stdint.h>

#include "cortex-m/cortex_m.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"

// HardFault and NMI: motors off first, then a report, then stop.

namespace firmtouch::hal {
namespace {

// HardFault status: a breakpoint was reached with no debugger attached.
constexpr uint32_t kFromDebugEvent = 1u << 31;
constexpr uint16_t kSemihostingCall = 0xBEAB;  // bkpt 0xAB
constexpr int kExitStatus = 70;                // exit code of an emulator's process

struct Frame {  // pushed by the core (ARM DDI 0403, B1.5.6)
  uint32_t r[4], r12, lr, pc, status;
};

void print_hex(const char* name, uint32_t value) {
  char text[] = "0x00000000 ";
  for (uint32_t i = 0; i < 8; ++i, value <<= 4) text[2 + i] = "0123456789abcdef"[value >> 28];
  board_print(name);
  board_print(text);
}

// Without a debugger a semihosting call faults: it then returns -1 and the program goes on.
bool skip_unattached_semihosting(Frame& frame) {
  if ((reg(kHardFaultStatus) & kFromDebugEvent) == 0) return false;
  if (*reinterpret_cast<const uint16_t*>(static_cast<uintptr_t>(frame.pc)) != kSemihostingCall)
    return false;
  reg(kHardFaultStatus) = kFromDebugEvent;
  frame.r[0] = UINT32_MAX;
  frame.pc += 2;
  return true;
}

}  // namespace

extern "C" {

/// `frame` is null after a stack overflow.
[[gnu::used]] void hard_fault(Frame* frame) {
  motors_off();
  if (frame != nullptr && skip_unattached_semihosting(*frame)) return;
  board_print("\nFault: motors are off. ");
  print_hex("status ", reg(kFaultStatus));
  if (frame != nullptr) {
    print_hex("pc ", frame->pc);
    print_hex("lr ", frame->lr);
    board_print("(find them with addr2line)\n");
  } else {
    board_print("Stack overflow: raise STACK_BYTES in the board's linker script.\n");
  }
  board_exit(kExitStatus);
}

[[gnu::naked]] void hard_fault_handler() {
  asm volatile(
      "mrs r0, msp             \n"
      "ldr r1, =__stack_bottom \n"
      "cmp r0, r1              \n"
      "bhs 1f                  \n"
      "ldr r1, =__stack_top    \n"
      "mov sp, r1              \n"
      "movs r0, #0             \n"
      "1: push {r4, lr}        \n"
      "bl hard_fault           \n"
      "pop {r4, pc}            \n");
}

}  // extern "C"
}  // namespace firmtouch::hal
