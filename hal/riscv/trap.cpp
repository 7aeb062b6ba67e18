#include "riscv/trap.hpp"

#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "parts/fault_text.hpp"

// Exceptions: motors off first, then a report, then stop. Interrupts: the machine timer.

extern "C" {
extern uint32_t __stack_bottom[];
}

namespace firmtouch::hal {
extern "C" {

/// `sp` of what was interrupted.
[[gnu::used]] void exception(uint32_t sp) {
  motors_off();
  uint32_t cause, pc, value;
  asm volatile("csrr %0, mcause" : "=r"(cause));
  asm volatile("csrr %0, mepc" : "=r"(pc));
  asm volatile("csrr %0, mtval" : "=r"(value));
  board_print("\nFault: motors are off. ");
  print_hex("cause ", cause);
  print_hex("pc ", pc);
  print_hex("value ", value);
  const uint32_t bottom = static_cast<uint32_t>(reinterpret_cast<uintptr_t>(__stack_bottom));
  const bool is_overflow = sp < bottom + 512 || value - (bottom - 0x8000) < 0x8000;
  board_print(is_overflow ? kStackOverflowText : "see addr2line\n");
  board_exit(kFaultExitStatus);
}

[[gnu::interrupt("machine"), gnu::used]] void interrupt() { machine_timer_handler(); }

/// Uses no stack: it may have overflowed.
[[gnu::naked, gnu::used, gnu::aligned(4)]] void trap_handler() {
  asm volatile(
      "csrw mscratch, t0   \n"
      "csrr t0, mcause     \n"
      "bgez t0, 1f         \n"
      "csrr t0, mscratch   \n"
      "j interrupt         \n"
      "1: mv a0, sp        \n"
      "la sp, __stack_top  \n"
      "j exception         \n");
}

}  // extern "C"
}  // namespace firmtouch::hal
