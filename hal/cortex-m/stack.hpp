#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Fills the unused stack with a pattern that stack_used_bytes() looks for. Start-up only.
void stack_paint();

/// Denies access to the 16 KB below the stack, the lowest thing in RAM: a stack overflow faults
/// even if the bus maps something there. Armv8-M can only deny writing, and has a limit register
/// besides. Uses MPU region GUARD_REGION of the linker script, 0 if it names none. No effect on a
/// core without an MPU.
void stack_guard();

/// Most bytes of stack in use since start-up, interrupts included.
uint32_t stack_used_bytes();
uint32_t stack_size_bytes();

}  // namespace firmtouch::hal
