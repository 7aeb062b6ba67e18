#include "riscv/trap.hpp"

#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"

// Exceptions: motors off first, then a report, then stop. Interrupts: the machine timer.

extern "C" {
extern uint32_t __stack_bottom[];
}

namespace firmtouch::hal {
namespace {

constexpr int kExitStatus = 70;  // exit code of an emulator's process

void print_hex(const char* name, uint32_t value) {
  char text[] = "0x00000000 ";
  for (uint32_t i = 0; i < 8; ++i, value <<= 4) text[2 + i] = "0123456789abcdef"[value >> 28];
  board_print(name);
  board_print(text);
}

}  // namespace

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
  board_print(is_overflow ? "Stack overflow: raise STACK_BYTES in the board's linker script.\n"
                          : "(find them with addr2line)\n");
  board_exit(kExitStatus);
}

[[gnu::interrupt("machine"), gnu::used]] void interrupt() { machine_timer_handler(); }

/// Uses no stack: it may have overflowed.
[[gnu::naked, gnu::aligned(4)]] void trap_handler() {
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
