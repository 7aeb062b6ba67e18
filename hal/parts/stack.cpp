#include "parts/stack.hpp"

extern "C" {
extern uint32_t __stack_bottom[], __stack_top[];
}

namespace firmtouch::hal {
namespace {

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

}  // namespace

void stack_paint() {
  const uint32_t* here;
#ifdef __riscv
  asm volatile("mv %0, sp" : "=r"(here));
#else
  asm volatile("mov %0, sp" : "=r"(here));
#endif
  for (volatile uint32_t* word = __stack_bottom; word < here - 16; ++word) *word = kStackPaint;
}

uint32_t stack_used_bytes() {
  const volatile uint32_t* word = __stack_bottom;
  while (word < __stack_top && *word == kStackPaint) ++word;
  return address(__stack_top) - address(const_cast<const uint32_t*>(word));
}

}  // namespace firmtouch::hal
