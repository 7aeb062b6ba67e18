#pragma once
// Eight floats at a time by the compiler's vector types: one instruction each with AVX, two with SSE,
// as many as it takes elsewhere; the same bits everywhere (nothing is contracted or reordered). A cast
// from one vector type to another keeps the bits.
#include <cstdint>

namespace firmtouch::tools {

constexpr uint32_t kLanes = 8;
#if defined(__AVX2__)
constexpr uint32_t kPartBytes = 32;
#else
constexpr uint32_t kPartBytes = 16;
#endif
constexpr uint32_t kParts = 32 / kPartBytes;
using LanePart = float __attribute__((vector_size(kPartBytes)));
using MaskPart = int32_t __attribute__((vector_size(kPartBytes)));

struct LaneMask {
  MaskPart part[kParts];
};

struct Lanes {
  LanePart part[kParts];

  Lanes() = default;
  explicit Lanes(float x) {
    for (LanePart& p : part) p = LanePart{} + x;
  }
  explicit Lanes(const float* from) { __builtin_memcpy(part, from, sizeof part); }
  void store(float* to) const { __builtin_memcpy(to, part, sizeof part); }
};

#define FIRMTOUCH_LANES [[gnu::always_inline]] inline

template <class Operation>
FIRMTOUCH_LANES Lanes each_part(const Lanes& a, const Lanes& b, const Operation& operation) {
  Lanes result;
  for (uint32_t i = 0; i < kParts; ++i) operation(a.part[i], b.part[i], result.part[i]);
  return result;
}
FIRMTOUCH_LANES Lanes operator+(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x + y; });
}
FIRMTOUCH_LANES Lanes operator-(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x - y; });
}
FIRMTOUCH_LANES Lanes operator*(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x * y; });
}
FIRMTOUCH_LANES Lanes operator/(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x / y; });
}
FIRMTOUCH_LANES LaneMask operator<(const Lanes& a, const Lanes& b) {
  LaneMask mask;
  for (uint32_t i = 0; i < kParts; ++i) mask.part[i] = a.part[i] < b.part[i];
  return mask;
}
FIRMTOUCH_LANES LaneMask operator&(const LaneMask& a, const LaneMask& b) {
  LaneMask mask;
  for (uint32_t i = 0; i < kParts; ++i) mask.part[i] = a.part[i] & b.part[i];
  return mask;
}
FIRMTOUCH_LANES Lanes choose(const LaneMask& mask, const Lanes& yes, const Lanes& no) {
  Lanes result;
  for (uint32_t i = 0; i < kParts; ++i) {
    result.part[i] =
        (LanePart)(((MaskPart)yes.part[i] & mask.part[i]) | ((MaskPart)no.part[i] & ~mask.part[i]));
  }
  return result;
}
FIRMTOUCH_LANES Lanes larger(const Lanes& a, const Lanes& b) { return choose(a < b, b, a); }
FIRMTOUCH_LANES Lanes smaller(const Lanes& a, const Lanes& b) { return choose(a < b, a, b); }
FIRMTOUCH_LANES Lanes square_root(const Lanes& a) {
#if defined(__AVX2__)
  Lanes result;
  result.part[0] = __builtin_ia32_sqrtps256(a.part[0]);
  return result;
#else
  alignas(16) float values[kLanes];
  a.store(values);
  for (float& value : values) value = __builtin_sqrtf(value);
  return Lanes(values);
#endif
}
/// One bit a lane.
FIRMTOUCH_LANES uint32_t bits_of_mask(const LaneMask& mask) {
#if defined(__AVX2__)
  return static_cast<uint32_t>(__builtin_ia32_movmskps256((LanePart)mask.part[0]));
#elif defined(__SSE2__)
  return static_cast<uint32_t>(__builtin_ia32_movmskps((LanePart)mask.part[0])) |
         static_cast<uint32_t>(__builtin_ia32_movmskps((LanePart)mask.part[1])) << 4;
#else
  uint32_t bits = 0;
  for (uint32_t i = 0; i < kLanes; ++i)
    bits |= static_cast<uint32_t>(mask.part[i / 4][i % 4] & 1) << i;
  return bits;
#endif
}

struct Lanes3 {
  Lanes x, y, z;
};
FIRMTOUCH_LANES Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
FIRMTOUCH_LANES Lanes3 operator*(const Lanes3& a, const Lanes& s) {
  return {a.x * s, a.y * s, a.z * s};
}
FIRMTOUCH_LANES Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
FIRMTOUCH_LANES Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

#undef FIRMTOUCH_LANES

}  // namespace firmtouch::tools
