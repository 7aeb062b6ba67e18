#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "parts/stack.hpp"

// From reset to main(): FPU, motors off, stack, data, constructors.

int main();  // not extern "C": clang mangles it in freestanding code

extern "C" {
extern uint32_t __data_begin[], __data_end[], __data_load[];
extern uint32_t __bss_end[];
using Constructor = void (*)();
extern Constructor __init_array_begin[], __init_array_end[];

[[noreturn, gnu::used]] void start_up() {
  firmtouch::hal::motors_off();
  firmtouch::hal::stack_paint();
  firmtouch::hal::stack_guard();
  const uint32_t* from = __data_load;
  uint32_t* to = __data_begin;
  while (to != __data_end) *to++ = *from++;
  while (to != __bss_end) *to++ = 0;  // it follows
  for (Constructor* make = __init_array_begin; make != __init_array_end; ++make) (*make)();
  firmtouch::hal::board_exit(main());
}

/// No interrupts, which a boot loader may have left on; FPU on, rounding to nearest; stack; traps.
[[gnu::naked, gnu::section(".reset"), noreturn]] void reset_handler() {
  asm volatile(
      ".option push; .option norelax     \n"
      "la gp, __global_pointer$          \n"
      ".option pop                       \n"
      "csrci mstatus, 8                  \n"
      "csrw mie, zero                    \n"
      "li t0, 0x2000                     \n"  // mstatus.FS: initial
      "csrs mstatus, t0                  \n"
      "csrw fcsr, zero                   \n"
      "la sp, __stack_top                \n"
      "la t0, trap_handler               \n"
      "csrw mtvec, t0                    \n"
      "j start_up                        \n");
}

}  // extern "C"
