#include "riscv/stack.hpp"

extern "C" {
extern uint32_t __stack_bottom[], __stack_top[];
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kPaint = 0x5AFE57AC;
constexpr uint32_t kGuard_bytes = 1u << 14;

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

}  // namespace

void stack_paint() {
  uint32_t here;
  asm volatile("mv %0, sp" : "=r"(here));
  const uint32_t* end = reinterpret_cast<const uint32_t*>(static_cast<uintptr_t>(here)) - 16;
  for (volatile uint32_t* word = __stack_bottom; word < end; ++word) *word = kPaint;
}

// A naturally aligned power of two (privileged specification 1.12, 3.7.1): locked, no access.
void stack_guard() {
  const uint32_t base = (address(__stack_bottom) - kGuard_bytes) & ~(kGuard_bytes - 1);
  asm volatile("csrw pmpaddr0, %0" ::"r"(base >> 2 | (kGuard_bytes / 8 - 1)));
  asm volatile("csrw pmpcfg0, %0" ::"r"(0x98));
}

uint32_t stack_used_bytes() {
  const volatile uint32_t* word = __stack_bottom;
  while (word < __stack_top && *word == kPaint) ++word;
  return address(__stack_top) - address(const_cast<const uint32_t*>(word));
}

}  // namespace firmtouch::hal
