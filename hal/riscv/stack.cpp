#include "parts/stack.hpp"

extern "C" {
extern uint32_t __stack_bottom[];
}

namespace firmtouch::hal {
namespace {

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

}  // namespace

// PMP entry 0, a naturally aligned power of two (privileged specification 1.12, 3.7.1): no access
// until reset, also in machine mode.
void stack_guard() {
  const uint32_t base = (address(__stack_bottom) - kStackGuard_bytes) & ~(kStackGuard_bytes - 1);
  asm volatile("csrw pmpaddr0, %0" ::"r"(base >> 2 | (kStackGuard_bytes / 8 - 1)));
  asm volatile("csrw pmpcfg0, %0" ::"r"(0x98));
}

}  // namespace firmtouch::hal
