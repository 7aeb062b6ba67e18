#pragma once
// Four floats at once, in the compiler's own vectors: SSE, NEON, or scalar code.

#include <stdint.h>

namespace firmtouch::simd {

typedef float Float4 __attribute__((vector_size(16)));
typedef int32_t Mask4 __attribute__((vector_size(16)));  // of a comparison: 0 or -1

#define FIRMTOUCH_LANES [[gnu::always_inline]] static inline

FIRMTOUCH_LANES Float4 four_from(const float* p) {
  Float4 four;
  __builtin_memcpy(&four, p, sizeof four);
  return four;
}
FIRMTOUCH_LANES Float4 four_of(float v) { return Float4{v, v, v, v}; }
FIRMTOUCH_LANES Mask4 as_bits(Float4 v) { return reinterpret_cast<Mask4>(v); }
FIRMTOUCH_LANES Float4 as_floats(Mask4 v) { return reinterpret_cast<Float4>(v); }

// a > b ? a : b and a < b ? a : b.
FIRMTOUCH_LANES Float4 larger(Float4 a, Float4 b) {
#if defined(__SSE__)
  return __builtin_ia32_maxps(a, b);
#else
  const Mask4 is = b < a;
  return as_floats((is & as_bits(a)) | (~is & as_bits(b)));
#endif
}
FIRMTOUCH_LANES Float4 smaller(Float4 a, Float4 b) {
#if defined(__SSE__)
  return __builtin_ia32_minps(a, b);
#else
  const Mask4 is = a < b;
  return as_floats((is & as_bits(a)) | (~is & as_bits(b)));
#endif
}
/// Bit k: lane k of the mask is set.
FIRMTOUCH_LANES uint32_t bits_of(Mask4 mask) {
#if defined(__SSE__)
  return static_cast<uint32_t>(__builtin_ia32_movmskps(as_floats(mask)));
#else
  uint32_t bits = 0;
  for (uint32_t k = 0; k < 4; ++k) bits |= mask[k] != 0 ? 1u << k : 0u;
  return bits;
#endif
}

#undef FIRMTOUCH_LANES

}  // namespace firmtouch::simd
