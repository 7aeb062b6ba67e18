#pragma once
// search/vectors.hpp in the compiler's own vectors of four floats: SSE, NEON, or scalar code.

#include <stdint.h>

namespace firmtouch::simd {

typedef float Float4 __attribute__((vector_size(16)));
typedef int32_t Mask4 __attribute__((vector_size(16)));  // of a comparison: 0 or -1

struct Float8 {
  Float4 low, high;
};
struct Mask8 {
  Mask4 low, high;
};

#define FIRMTOUCH_LANES [[gnu::always_inline]] static inline

FIRMTOUCH_LANES Float8 operator+(Float8 a, Float8 b) { return {a.low + b.low, a.high + b.high}; }
FIRMTOUCH_LANES Float8 operator-(Float8 a, Float8 b) { return {a.low - b.low, a.high - b.high}; }
FIRMTOUCH_LANES Float8 operator*(Float8 a, Float8 b) { return {a.low * b.low, a.high * b.high}; }
FIRMTOUCH_LANES Float8 operator/(Float8 a, Float8 b) { return {a.low / b.low, a.high / b.high}; }
FIRMTOUCH_LANES Float8 operator-(Float8 a) { return {-a.low, -a.high}; }
FIRMTOUCH_LANES Mask8 operator&(Mask8 a, Mask8 b) { return {a.low & b.low, a.high & b.high}; }
FIRMTOUCH_LANES Mask8 operator|(Mask8 a, Mask8 b) { return {a.low | b.low, a.high | b.high}; }
FIRMTOUCH_LANES Mask8 operator~(Mask8 a) { return {~a.low, ~a.high}; }

FIRMTOUCH_LANES Float8 lanes_from(const float* p) {
  Float8 lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return lanes;
}
FIRMTOUCH_LANES Float8 all_of(float v) { return {Float4{v, v, v, v}, Float4{v, v, v, v}}; }
FIRMTOUCH_LANES Mask8 all_of_bits(int32_t v) { return {Mask4{v, v, v, v}, Mask4{v, v, v, v}}; }
FIRMTOUCH_LANES float lane_of(const Float8& v, uint32_t lane) {
  return lane < 4 ? v.low[lane] : v.high[lane - 4];
}
FIRMTOUCH_LANES int32_t lane_of(const Mask8& v, uint32_t lane) {
  return lane < 4 ? v.low[lane] : v.high[lane - 4];
}

FIRMTOUCH_LANES Mask8 less(Float8 a, Float8 b) { return {a.low < b.low, a.high < b.high}; }
FIRMTOUCH_LANES Mask8 at_most(Float8 a, Float8 b) { return {a.low <= b.low, a.high <= b.high}; }
FIRMTOUCH_LANES Mask8 select(Mask8 mask, Mask8 a, Mask8 b) { return (mask & a) | (~mask & b); }
FIRMTOUCH_LANES Mask8 as_bits(Float8 v) {
  return {reinterpret_cast<Mask4>(v.low), reinterpret_cast<Mask4>(v.high)};
}
FIRMTOUCH_LANES Float8 as_floats(Mask8 v) {
  return {reinterpret_cast<Float4>(v.low), reinterpret_cast<Float4>(v.high)};
}
FIRMTOUCH_LANES Float8 select(Mask8 mask, Float8 a, Float8 b) {
  return as_floats(select(mask, as_bits(a), as_bits(b)));
}
FIRMTOUCH_LANES Float8 only(Mask8 mask, Float8 v) { return as_floats(as_bits(v) & mask); }
FIRMTOUCH_LANES Float8 larger(Float8 a, Float8 b) { return select(less(b, a), a, b); }
FIRMTOUCH_LANES Float8 smaller(Float8 a, Float8 b) { return select(less(a, b), a, b); }
FIRMTOUCH_LANES uint32_t bits_of(Mask8 mask) {
#if defined(__SSE2__)
  typedef float Vector __attribute__((vector_size(16)));
  return static_cast<uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<Vector>(mask.low))) |
         static_cast<uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<Vector>(mask.high))) << 4;
#else
  uint32_t bits = 0;
  for (uint32_t k = 0; k < 8; ++k) bits |= lane_of(mask, k) != 0 ? 1u << k : 0u;
  return bits;
#endif
}

constexpr float kMaxMinimum = 0x1.fffffep127f;
FIRMTOUCH_LANES uint32_t minimum_lane(Float8 v, uint32_t of, float& minimum) {
  uint32_t lane = static_cast<uint32_t>(__builtin_ctz(of));
  for (uint32_t left = of; left != 0; left &= left - 1) {
    const uint32_t k = static_cast<uint32_t>(__builtin_ctz(left));
    lane = lane_of(v, k) < lane_of(v, lane) ? k : lane;
  }
  minimum = lane_of(v, lane);
  return lane;
}
FIRMTOUCH_LANES float minimum_of(Float8 v, uint32_t of) {
  float minimum = kMaxMinimum;
  for (uint32_t left = of; left != 0; left &= left - 1) {
    const float value = lane_of(v, static_cast<uint32_t>(__builtin_ctz(left)));
    minimum = value < minimum ? value : minimum;
  }
  return minimum;
}

#undef FIRMTOUCH_LANES

}  // namespace firmtouch::simd
