#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Fills the unused stack with a pattern, so that stack_used_bytes() can tell later how deep it went. At start-up only.
void stack_paint();

/// Forbids the 16 KB under the stack, which is the lowest thing in RAM, so that a stack that grows
/// too far faults even where a bus has something there. Does nothing on a core without an MPU.
void stack_guard();

/// Most bytes of stack that were in use since start-up, interrupts included.
uint32_t stack_used_bytes();
uint32_t stack_size_bytes();

}  // namespace firmtouch::hal
