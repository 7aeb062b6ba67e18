#pragma once
#include <stdint.h>

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::query {

/// A section of probe queries with the hash of the baker's answers. A controller that computes
/// other bits (floating-point mode, compiler flags, broken FPU, damaged asset) finds out before it
/// enables a motor.
struct ProbeHead {
  uint32_t count;     // points that follow
  uint32_t reserved;  // 0
  uint32_t hash_low;  // core::Hash over the bits of all answers
  uint32_t hash_high;
};
static_assert(sizeof(ProbeHead) == 16);

struct ProbePoint {
  float x_m, y_m, z_m;
};
static_assert(sizeof(ProbePoint) == 12);

/// Work of a probe query: whatever the asset, its slice of the opening takes no more than 100,000
/// instructions of a Cortex-M7 (README.md has the bounds).
constexpr Budget kProbeBudget{256};

struct Probes {
  core::Span<const ProbePoint> points;
  uint64_t hash = 0;
};

/// At most so many points run in one slice; the baker writes 64.
constexpr uint32_t kMaxProbes = 256;

constexpr bool is_sensible(const Probes& probes) {
  return !probes.points.empty() && probes.points.size() <= kMaxProbes;
}

/// Result: no points where the bytes are not such a section.
[[gnu::noinline]] inline Probes read_probes(core::Bytes bytes) {
  const core::Span<const ProbeHead> head = core::as_array<ProbeHead>(bytes, 1);
  if (head.empty() || head[0].reserved != 0) return {};
  const core::Bytes rest(bytes.data() + sizeof(ProbeHead),
                         static_cast<uint32_t>(bytes.size() - sizeof(ProbeHead)));
  const core::Span<const ProbePoint> points = core::as_whole_array<ProbePoint>(rest);
  if (points.size() != head[0].count) return {};
  return {points, (static_cast<uint64_t>(head[0].hash_high) << 32) | head[0].hash_low};
}

}  // namespace firmtouch::query
