#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Fills the unused stack with a pattern that stack_used_bytes() looks for. Start-up only.
void stack_paint();

/// Denies access to the 16 KB below the stack by PMP entry 0, also in machine mode, until reset.
void stack_guard();

/// Most bytes of stack in use since start-up, interrupts included.
uint32_t stack_used_bytes();

}  // namespace firmtouch::hal
