#include <stdint.h>

#include "cortex-m/cortex_m.hpp"
#include "cortex-m/floating_point.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/motors.hpp"
#include "parts/stack.hpp"

// From reset to main(): FPU, motors off, stack, data, constructors.

int main();  // not extern "C": clang mangles it in freestanding code

extern "C" {
extern uint32_t __stack_top[];
extern const uint32_t __vectors[];
extern uint32_t __data_begin[], __data_end[], __data_load[];
extern uint32_t __bss_end[];
extern firmtouch::hal::Handler __init_array_begin[], __init_array_end[];

void hard_fault_handler();
void servo_timer_handler();

/// The motors first: their pins may float, or be as a reset found them. Nothing is initialised yet.
/// A boot loader may have left its vectors, interrupts on, and all masked. SysTick does no harm.
[[noreturn, gnu::used]] void start_up() {
  using namespace firmtouch;  // NOLINT: no namespace of its own, for the assembler
  hal::motors_off();
  hal::floating_point_begin();
  // The table is first in CODE.
  hal::reg(hal::kVectorTable) = static_cast<uint32_t>(reinterpret_cast<uintptr_t>(__vectors));
  hal::reg(hal::kInterruptState) = 1u << 27;  // PendSV is not pending
  for (uint32_t word = 0; word != 64; word += 4) hal::reg(hal::kNvicDisable + word) = UINT32_MAX;
  hal::stack_paint();
  hal::stack_guard();
  const uint32_t* from = __data_load;
  uint32_t* to = __data_begin;
  while (to != __data_end) *to++ = *from++;
  while (to != __bss_end) *to++ = 0;  // it follows
  for (hal::Handler* make = __init_array_begin; make != __init_array_end; ++make) (*make)();
  asm volatile("cpsie i" ::: "memory");
  hal::board_exit(main());
}

/// On the main stack, without an interrupt. Naked, and the FPU first: the next function's prologue
/// may already save floating-point registers.
[[gnu::naked, noreturn]] void reset_handler() {
  asm volatile(
      "cpsid i             \n"
      "movs r0, #0         \n"
      "msr basepri, r0     \n"
#if __ARM_ARCH >= 8
      "msr msplim, r0      \n"
#endif
      "msr control, r0     \n"
      "isb                 \n"
      "ldr r0, =__stack_top \n"
      "mov sp, r0          \n"
      "ldr r0, =0xE000ED88 \n"  // CPACR: full access to coprocessors 10 and 11
      "ldr r1, [r0]        \n"
      "orr r1, #0xF00000   \n"
      "str r1, [r0]        \n"
      "dsb                 \n"
      "isb                 \n"
      "b start_up          \n"
      ".ltorg              \n");  // CPACR's address, within reach
}

[[gnu::section(".vectors.core"), gnu::used]] const firmtouch::hal::Handler kCoreVectors[16] = {
    reinterpret_cast<firmtouch::hal::Handler>(__stack_top),
    reset_handler,
    hard_fault_handler,  // NMI: the watchdog's first warning
    hard_fault_handler,
    hard_fault_handler,  // memory, bus, usage: not enabled, so they come as HardFault
    hard_fault_handler,
    hard_fault_handler,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    hard_fault_handler,  // SVC, debug monitor, PendSV: not used
    hard_fault_handler,
    nullptr,
    hard_fault_handler,
    servo_timer_handler,
};

}  // extern "C"
