#pragma once
#include <stdint.h>

namespace firmtouch::hal {

constexpr uint32_t kStackPaint = 0x5AFE57AC;      // fills the unused stack from start-up on
constexpr uint32_t kStackGuard_bytes = 1u << 14;  // no access below the stack

/// Fills the unused stack with a pattern that stack_used_bytes() looks for. Start-up only.
void stack_paint();

/// Denies access to the 16 KB below the stack, the lowest thing in RAM: a stack overflow faults
/// even if the bus maps something there. Start-up only.
void stack_guard();

/// Most bytes of stack in use since start-up, interrupts included.
uint32_t stack_used_bytes();

}  // namespace firmtouch::hal
