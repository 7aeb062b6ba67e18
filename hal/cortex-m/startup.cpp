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
extern uint32_t __bss_begin[], __bss_end[];
extern firmtouch::hal::Handler __init_array_begin[], __init_array_end[];

void hard_fault_handler();
void servo_timer_handler();

/// The motors first: their pins may float, or be as a reset found them. Nothing is initialised yet.
[[noreturn, gnu::used]] void start_up() {
  firmtouch::hal::motors_off();
  firmtouch::hal::floating_point_begin();
  // A boot loader may have left its own. The table is first in CODE.
  firmtouch::hal::reg(firmtouch::hal::kVectorTable) =
      static_cast<uint32_t>(reinterpret_cast<uintptr_t>(__vectors));
  firmtouch::hal::stack_paint();
  firmtouch::hal::stack_guard();
  const uint32_t* from = __data_load;
  for (uint32_t* to = __data_begin; to < __data_end; ++to) *to = *from++;
  for (uint32_t* to = __bss_begin; to < __bss_end; ++to) *to = 0;
  for (firmtouch::hal::Handler* make = __init_array_begin; make < __init_array_end; ++make)
    (*make)();
  firmtouch::hal::board_exit(main());
}

/// Naked, and the FPU first: the next function's prologue may already save floating-point
/// registers.
[[gnu::naked, noreturn]] void reset_handler() {
  asm volatile(
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
