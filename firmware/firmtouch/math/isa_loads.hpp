#pragma once
// How vectors of an array are fetched in few instructions, with the variants of math/isa.hpp's
// kind. For the library's own translation units.

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

/// Puts two words behind `top`, the last of a stack, and moves it there: by one instruction where
/// the processor has it.
[[gnu::always_inline]] static inline void push_pair(uint32_t*& top, uint32_t first,
                                                    uint32_t second) {
#if FIRMTOUCH_ISA_PAIRS
  struct Pair {
    uint32_t word[2];
  };
  Pair& pair = *reinterpret_cast<Pair*>(top);
  __asm__("strd %2, %3, [%0], #8" : "+r"(top), "=m"(pair) : "r"(first), "r"(second));
#else
  top[0] = first, top[1] = second, top += 2;
#endif
}

/// Takes one off `count`. Result: whether something is left. Where the processor can by one
/// instruction that the branch reads: a compiler that counts early compares once more.
[[gnu::always_inline]] static inline bool count_down(uint32_t& count) {
#if FIRMTOUCH_ISA_PAIRS && defined(__GCC_ASM_FLAG_OUTPUTS__)
  bool is_left;
  __asm__("subs %0, %0, #1" : "+r"(count), "=@ccne"(is_left));
  return is_left;
#else
  return --count != 0;
#endif
}

/// What `from` points to; moves it to the next: by one instruction where the processor has it.
template <class Index>
[[gnu::always_inline]] static inline uint32_t next_of(const Index*& from) {
#if FIRMTOUCH_ISA_PAIRS
  uint32_t value;
  if constexpr (sizeof(Index) == 2)
    __asm__("ldrh %0, [%1], #2" : "=r"(value), "+r"(from) : "m"(*from));
  else
    __asm__("ldr %0, [%1], #4" : "=r"(value), "+r"(from) : "m"(*from));
  return value;
#else
  return *from++;
#endif
}

/// `value`, of which nothing is computed before it is needed: a compiler would keep in registers
/// for a whole loop what few turns need.
static inline uint32_t only_here(uint32_t value) {
#if FIRMTOUCH_ISA_PAIRS
  __asm__ volatile("" : "+r"(value));
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

/// Five floats, into registers that a call keeps.
[[gnu::always_inline]] static inline void load_kept(const float* from, float (&to)[5]) {
#if FIRMTOUCH_ISA_BLOCKS
  struct Block {
    float value[5];
  };
  register float v0 __asm__("s16"), v1 __asm__("s17"), v2 __asm__("s18"), v3 __asm__("s19"),
      v4 __asm__("s20");
  __asm__("vldmia %5, {%0-%4}"
          : "=t"(v0), "=t"(v1), "=t"(v2), "=t"(v3), "=t"(v4)
          : "r"(from), "m"(*reinterpret_cast<const Block*>(from)));
  to[0] = v0, to[1] = v1, to[2] = v2, to[3] = v3, to[4] = v4;
#else
  for (int i = 0; i < 5; ++i) to[i] = from[i];
#endif
}

}  // namespace firmtouch::math
