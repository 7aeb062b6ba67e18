#pragma once
// Eight floats at a time by the compiler's vector types: one instruction each with AVX, two with
// SSE, as many as it takes elsewhere; the same bits everywhere (nothing is contracted or
// reordered). A cast from one vector type to another keeps the bits.
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

template <class Result = Lanes, class Given, class Operation>
FIRMTOUCH_LANES Result each_part(const Given& a, const Given& b, const Operation& operation) {
  Result result;
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
  return each_part<LaneMask>(a, b, [](const auto& x, const auto& y, auto& to) { to = x < y; });
}
FIRMTOUCH_LANES LaneMask operator&(const LaneMask& a, const LaneMask& b) {
  return each_part<LaneMask>(a, b, [](const auto& x, const auto& y, auto& to) { to = x & y; });
}
FIRMTOUCH_LANES Lanes choose(const LaneMask& mask, const Lanes& yes, const Lanes& no) {
  Lanes result;
  for (uint32_t i = 0; i < kParts; ++i) {
    result.part[i] =
        (LanePart)(((MaskPart)yes.part[i] & mask.part[i]) | ((MaskPart)no.part[i] & ~mask.part[i]));
  }
  return result;
}
// One instruction each, the processor's own: `a` where neither is the larger or smaller.
FIRMTOUCH_LANES Lanes larger(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x < y ? y : x; });
}
FIRMTOUCH_LANES Lanes smaller(const Lanes& a, const Lanes& b) {
  return each_part(a, b, [](const auto& x, const auto& y, auto& to) { to = x < y ? x : y; });
}
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

/// Eight rows of eight floats turned: columns[k] holds the k-th of each row.
FIRMTOUCH_LANES void turn(const float* const (&rows)[kLanes], Lanes (&columns)[kLanes]) {
#if defined(__AVX2__)
  LanePart row[kLanes], pair[kLanes], four[kLanes];
  for (uint32_t i = 0; i < kLanes; ++i) __builtin_memcpy(&row[i], rows[i], sizeof row[i]);
  for (uint32_t i = 0; i < kLanes; i += 2) {
    pair[i] = __builtin_shufflevector(row[i], row[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    pair[i + 1] = __builtin_shufflevector(row[i], row[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (uint32_t i = 0; i < kLanes; i += 4)
    for (uint32_t k = 0; k < 2; ++k) {
      const LanePart &a = pair[i + k], &b = pair[i + k + 2];
      four[i + 2 * k] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
      four[i + 2 * k + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (uint32_t k = 0; k < 4; ++k) {
    const LanePart &a = four[k], &b = four[k + 4];
    columns[k].part[0] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
    columns[k + 4].part[0] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
#else
  float at[kLanes][kLanes];
  for (uint32_t i = 0; i < kLanes; ++i)
    for (uint32_t k = 0; k < kLanes; ++k) at[k][i] = rows[i][k];
  for (uint32_t k = 0; k < kLanes; ++k) columns[k] = Lanes(at[k]);
#endif
}

/// For each set of eight lanes the lanes that it holds, in their order.
struct LaneOrders {
  uint8_t lane[1u << kLanes][kLanes];

  constexpr LaneOrders() : lane{} {
    for (uint32_t bits = 0; bits < 1u << kLanes; ++bits)
      for (uint32_t i = 0, n = 0; i < kLanes; ++i)
        if ((bits >> i & 1u) != 0) lane[bits][n++] = static_cast<uint8_t>(i);
  }
};
inline constexpr LaneOrders kLaneOrders;

/// Writes those of eight whose bit is set, in their order; what lies behind them in `to` is
/// overwritten. Result: how many.
FIRMTOUCH_LANES uint32_t keep(const uint32_t* from, uint32_t bits, uint32_t* to) {
#if defined(__AVX2__)
  using Bytes = uint8_t __attribute__((vector_size(kLanes)));
  Bytes order;
  MaskPart words;
  __builtin_memcpy(&order, kLaneOrders.lane[bits], sizeof order);
  __builtin_memcpy(&words, from, sizeof words);
  words = __builtin_ia32_permvarsi256(words, __builtin_convertvector(order, MaskPart));
  __builtin_memcpy(to, &words, sizeof words);
#else
  for (uint32_t i = 0; i < kLanes; ++i) to[i] = from[kLaneOrders.lane[bits][i]];
#endif
  return static_cast<uint32_t>(__builtin_popcount(bits));
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
