#pragma once
// search/vectors.hpp in the compiler's own vectors of four floats: SSE, NEON, or scalar code.

#include "simd/search/four_floats.hpp"

namespace firmtouch::simd {

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
FIRMTOUCH_LANES Float8 all_of(float v) { return {four_of(v), four_of(v)}; }
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
FIRMTOUCH_LANES Mask8 as_bits(Float8 v) { return {as_bits(v.low), as_bits(v.high)}; }
FIRMTOUCH_LANES Float8 as_floats(Mask8 v) { return {as_floats(v.low), as_floats(v.high)}; }
FIRMTOUCH_LANES Float8 select(Mask8 mask, Float8 a, Float8 b) {
  return as_floats(select(mask, as_bits(a), as_bits(b)));
}
FIRMTOUCH_LANES Float8 only(Mask8 mask, Float8 v) { return as_floats(as_bits(v) & mask); }
FIRMTOUCH_LANES Float8 larger(Float8 a, Float8 b) {
  return {larger(a.low, b.low), larger(a.high, b.high)};
}
FIRMTOUCH_LANES Float8 smaller(Float8 a, Float8 b) {
  return {smaller(a.low, b.low), smaller(a.high, b.high)};
}
FIRMTOUCH_LANES uint32_t bits_of(Mask8 mask) { return bits_of(mask.low) | bits_of(mask.high) << 4; }

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
