#include "parts/stack.hpp"

#include "cortex-m/cortex_m.hpp"

extern "C" {
extern uint32_t __stack_bottom[];
extern const uint8_t __firmtouch_guard_region[];  // its address is the number
}

namespace firmtouch::hal {
namespace {

uint32_t address(const void* p) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(p)); }

#if __ARM_ARCH >= 8
// The limit register stops pushes, the region every other access (ARM DDI 0553, B3.12 and B10).
void guard_below(uint32_t bottom) {
  asm volatile("msr msplim, %0" ::"r"(bottom));
  reg(kMpuAttributes) = 0;  // attribute 0: device memory
  reg(kMpuBase) =
      (bottom - kStackGuard_bytes) | 2u << 1 | 1u;  // read-only, privileged; never executed
  reg(kMpuSize) = (bottom - 32) | 1u;               // its last 32 bytes; attribute 0; on
}
#else
void guard_below(uint32_t bottom) {
  reg(kMpuBase) = (bottom - kStackGuard_bytes) & ~(kStackGuard_bytes - 1);
  reg(kMpuSize) = 1u << 28 | 13u << 1 | 1u;  // never executed, no access, 2^(13 + 1) bytes
}
#endif

}  // namespace

// Armv8-M can only deny writing, and has a limit register besides. Uses MPU region GUARD_REGION of
// the linker script, 0 if it names none. No effect on a core without an MPU.
void stack_guard() {
  if ((reg(kMpuType) >> 8 & 0xFFu) == 0) return;
  reg(kMpuRegion) = address(__firmtouch_guard_region);
  guard_below(address(__stack_bottom));
  reg(kMpuControl) = 5;  // the rest of memory as without an MPU
  asm volatile("dsb\n isb");
}

}  // namespace firmtouch::hal
