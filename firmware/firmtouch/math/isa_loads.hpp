#pragma once
// How vectors of an array are fetched in few instructions, with the variants of math/isa.hpp's kind.
// For the library's own translation units.

#include "firmtouch/math/isa.hpp"

namespace firmtouch::math {

/// `value`, kept from a compiler that would rather shift and add than multiply by it, which takes
/// more instructions.
static inline uint32_t as_multiplier(uint32_t value) {
#if FIRMTOUCH_ISA_PAIRS
  __asm__("" : "+r"(value));
#endif
  return value;
}

/// Three floats that lie one behind the other: where the processor can by one instruction, which
/// needs registers in a row; those of kBlock, 0 to 2, for three that are loaded together. Into
/// floats: a struct of them would be stored aside.
template <int kBlock>
[[gnu::always_inline]] static inline void load_floats(const float* from, float& x, float& y,
                                                      float& z) {
#if FIRMTOUCH_ISA_BLOCKS
  struct Block {
    float value[3];
  };
  const Block& source = *reinterpret_cast<const Block*>(from);
  if constexpr (kBlock == 0) {
    register float first __asm__("s0"), second __asm__("s1"), third __asm__("s2");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  } else if constexpr (kBlock == 1) {
    register float first __asm__("s3"), second __asm__("s4"), third __asm__("s5");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  } else {
    register float first __asm__("s6"), second __asm__("s7"), third __asm__("s8");
    __asm__("vldmia %3, {%0-%2}" : "=t"(first), "=t"(second), "=t"(third) : "r"(from), "m"(source));
    x = first, y = second, z = third;
  }
#else
  x = from[0], y = from[1], z = from[2];
#endif
}

}  // namespace firmtouch::math
