#include "cortex-m/stack.hpp"

#include "cortex-m/cortex_m.hpp"

extern "C" {
extern uint32_t __stack_bottom[], __stack_top[];
}

namespace firmtouch::hal {
namespace {

constexpr uint32_t kPaint = 0x5AFE57AC;

uint32_t bytes_between(const uint32_t* low, const uint32_t* high) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(high) -
                               reinterpret_cast<uintptr_t>(low));
}

}  // namespace

void stack_paint() {
  uint32_t here;
  asm volatile("mov %0, sp" : "=r"(here));
  const uint32_t* end = reinterpret_cast<const uint32_t*>(static_cast<uintptr_t>(here)) - 16;
  for (volatile uint32_t* word = __stack_bottom; word < end; ++word) *word = kPaint;
}

void stack_guard() {
  constexpr uint32_t kGuard_bytes = 1u << 14;
  if ((reg(kMpuType) >> 8 & 0xFFu) == 0) return;
  const uint32_t bottom = bytes_between(nullptr, __stack_bottom);
  reg(kMpuRegion) = 0;
  reg(kMpuBase) = (bottom - kGuard_bytes) & ~(kGuard_bytes - 1);
  reg(kMpuSize) = 1u << 28 | 13u << 1 | 1u;  // never executed, no access, 2^(13 + 1) bytes
  reg(kMpuControl) = 5;                      // the rest of memory as without an MPU
  asm volatile("dsb\n isb");
}

uint32_t stack_used_bytes() {
  const volatile uint32_t* word = __stack_bottom;
  while (word < __stack_top && *word == kPaint) ++word;
  return bytes_between(const_cast<const uint32_t*>(word), __stack_top);
}

uint32_t stack_size_bytes() { return bytes_between(__stack_bottom, __stack_top); }

}  // namespace firmtouch::hal
