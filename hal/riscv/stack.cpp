#include "parts/stack.hpp"

extern "C" {
extern uint32_t __stack_bottom[];
}

namespace firmtouch::hal {
namespace {

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

}  // namespace

void stack_paint() {
  uint32_t here;
  asm volatile("mv %0, sp" : "=r"(here));
  const uint32_t* end = reinterpret_cast<const uint32_t*>(static_cast<uintptr_t>(here)) - 16;
  for (volatile uint32_t* word = __stack_bottom; word < end; ++word) *word = kStackPaint;
}

// PMP entry 0, a naturally aligned power of two (privileged specification 1.12, 3.7.1): no access
// until reset, also in machine mode.
void stack_guard() {
  const uint32_t base = (address(__stack_bottom) - kStackGuard_bytes) & ~(kStackGuard_bytes - 1);
  asm volatile("csrw pmpaddr0, %0" ::"r"(base >> 2 | (kStackGuard_bytes / 8 - 1)));
  asm volatile("csrw pmpcfg0, %0" ::"r"(0x98));
}

}  // namespace firmtouch::hal
