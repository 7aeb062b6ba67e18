#pragma once
#include <stdint.h>

#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/probe_run.hpp"

namespace firmtouch::mesh {

/// The part of a triangle that a closest point lies on. Edge k runs from corner k to corner k + 1.
enum class Feature : uint8_t { kFace, kEdge0, kEdge1, kEdge2, kVertex0, kVertex1, kVertex2 };

constexpr bool is_edge(Feature f) { return f >= Feature::kEdge0 && f <= Feature::kEdge2; }
constexpr bool is_vertex(Feature f) { return f >= Feature::kVertex0; }

struct Closest {
  float distance_m = 0;  // signed: negative inside; positive if the sign is unknown
  math::Vec3 point_m;    // on the surface
  math::Vec3
      direction;  // unit pseudonormal of the feature, outward (unsigned mesh: the face's normal)
  uint32_t triangle = 0;  // in leaf order
  Feature feature = Feature::kFace;
  query::Certificate certificate;
};

/// Closest point of the surface to `p_m` (mesh frame), with sign and certificate.
/// Cold: one descent to a leaf, nearer child first, then the box with the least bound first. Warm:
/// from the last leaf upward, until the last certificate excludes the rest.
/// Bounds: <= budget.work units; 2.1 KB of stack; re-entrant; callable from an interrupt.
/// Result: always finite. Two triangles equally near: the one visited first. Outside the mesh's
///         grid the sign is known under any budget. A query that is not finite: a vertex, at
///         distance FLT_MAX, lower 0, not exact, sign 0.
/// Error: if exact, |distance| and lower_m within 4e-7 max(diagonal, distance); lower_m never above
///         the truth (mesh/loss.hpp; tests/mesh/compensated_host_test.cpp). If float32 is not
///         enough (far away, or few large triangles), the nearest triangle is measured in
///         compensated arithmetic. If that is not enough either, the search runs a second time:
///         some thousand instructions more, counted in steps.
/// Source: Baerentzen & Aanaes 2005, sections 3 and 4; Morris 2006, 3.3 (ascend from the last
///         leaf).
Closest closest_point(const View& mesh, math::Vec3 p_m, query::Budget budget, Hint& hint);

/// Probe queries, one after the other with one hint.
struct Prober {
  void answer(const View& mesh, math::Vec3 p_m, const query::Budget& budget, core::Hash& hash);
  Hint hint;
};
using ProbeRun = query::ProbeRun<Prober>;

/// Hash of the bits of the answers to `points`.
uint64_t probe_hash(const View& mesh, core::Span<const query::ProbePoint> points);

}  // namespace firmtouch::mesh
