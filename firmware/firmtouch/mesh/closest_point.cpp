#include "firmtouch/mesh/closest_point.hpp"

#include <float.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/mesh/nearest_search.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::mesh {
namespace {

// What float32 can lose in a triangle's distance, beside max(diagonal, distance): measured at most
// 1.5e-7 (tests/mesh/triangle_host_test.cpp, slivers of 1e7 to 1 included). Twice this is what an
// exact answer promises.
constexpr float kDistanceError = 2e-7f;

// A new fence stands this many of the last motions beyond the nearest leaf: nearer, it must soon be
// renewed; farther, more lies inside it. Of 6, 8, 12 and 16, 8 served the worst touching
// walks (2 % apart).
constexpr float kFenceMotions = 8.0f;

// A query farther than this from the origin: squares overflow beyond 1e19, and no model is larger
// than 1e6 m.
constexpr float kBeyond_m = 1e15f;

Vec3 feature_direction(const View& mesh, const Best& best) {
  const Triangle<uint32_t> t = mesh.triangle(best.triangle);
  const Vec3 a = mesh.vertex(t.corner[0]), b = mesh.vertex(t.corner[1]),
             c = mesh.vertex(t.corner[2]);
  const Vec3 normal = unit_normal(a, b, c);
  if (best.feature == Feature::kFace || !mesh.is_signed()) return normal;
  if (is_vertex(best.feature)) {
    const uint32_t corner =
        static_cast<uint32_t>(best.feature) - static_cast<uint32_t>(Feature::kVertex0);
    return decode_vertex_normal(mesh.vertex_normals()[t.corner[corner]]);
  }
  const uint32_t k = static_cast<uint32_t>(best.feature) - static_cast<uint32_t>(Feature::kEdge0);
  const Vec3 edge = k == 0 ? b - a : k == 1 ? c - b : a - c;
  return decode_edge_normal(normal, edge, mesh.folds()[best.triangle].fold[k]);
}

bool is_place(const View& mesh, uint32_t place) {
  return (place >> 1) < mesh.nodes().size() && is_leaf(mesh.nodes()[place >> 1].child[place & 1]);
}

template <class Bound>
Closest answer(const View& mesh, const Bound& bound, Vec3 p_m, query::Budget budget,
               query::Hint& hint) {
  const query::Carried carried = query::carry(hint, p_m);
  Search search;
  uint32_t start = hint.place;
  if (!is_place(mesh, start)) {
    start = query::
        kNowhere;  // cold: a stored vertex is a point of the surface before any triangle is reached
    search.best.offset_m = p_m - mesh.vertex(mesh.triangle(0).corner[0]);
    search.best.distance2_m2 = dot(search.best.offset_m, search.best.offset_m);
  }
  search.fence = hint.fence;
  search.fence_m = carried.fence_m;
  search.fence_margin_m = kFenceMotions * carried.motion_m;
  if (!mesh.triangles16().empty())
    search_nearest(mesh, mesh.triangles16(), bound, p_m, budget.steps, start, search);
  else
    search_nearest(mesh, mesh.triangles32(), bound, p_m, budget.steps, start, search);
  const Best& best = search.best;

  Closest closest;
  const float distance_m = math::square_root(best.distance2_m2);
  const float scale_m = distance_m > mesh.head().diagonal_m ? distance_m : mesh.head().diagonal_m;
  float lower_m = distance_m - kDistanceError * scale_m;
  if (!search.complete && search.pending_m < lower_m) lower_m = search.pending_m;
  if (!(lower_m > 0.0f)) lower_m = 0.0f;
  // The carried bound is worth keeping where the search was cut short; after a complete one it can
  // only be older.
  if (!search.complete && carried.lower_m > lower_m) lower_m = carried.lower_m;

  closest.point_m = bound.foot_m(mesh, p_m, best.offset_m, best.triangle);
  closest.direction = feature_direction(mesh, best);
  closest.triangle = best.triangle;
  closest.feature = best.feature;
  closest.certificate.lower_m = lower_m;
  closest.certificate.steps = search.steps;
  closest.certificate.exact = search.complete;
  if (mesh.is_signed()) {
    const int8_t side = dot(best.offset_m, closest.direction) >= 0.0f ? 1 : -1;
    closest.certificate.sign = bound.is_outside() ? 1 : search.complete ? side : carried.sign;
  }
  closest.distance_m = closest.certificate.sign < 0 ? -distance_m : distance_m;

  if (best.place != query::kNowhere) hint.place = best.place;
  hint.position_m = p_m;
  hint.lower_m = lower_m;
  hint.sign = closest.certificate.sign;
  hint.fence = search.fence;
  hint.fence_m = search.fence_m;
  return closest;
}

// So far away that every vertex is as near as any other to 1e-9: no square of such a distance fits
// a float.
Closest answer_beyond(const View& mesh, Vec3 p_m, query::Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = unit(Vec3{p_m.x * 0x1p-100f, p_m.y * 0x1p-100f, p_m.z * 0x1p-100f});
  closest.feature = Feature::kVertex0;
  closest.certificate.steps = 1;
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate.lower_m = fits ? closest.distance_m * (1.0f - kDistanceError) : 0x1.fff0p127f;
  closest.certificate.exact = fits;
  closest.certificate.sign = mesh.is_signed() ? 1 : 0;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = closest.certificate.sign;
  hint.fence = query::kNowhere;
  return closest;
}

Closest answer_nothing(const View& mesh, query::Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = {0, 0, 1};
  closest.distance_m = FLT_MAX;
  closest.feature = Feature::kVertex0;
  hint.lower_m = 0;
  hint.sign = 0;
  hint.fence = query::kNowhere;
  return closest;
}

}  // namespace

Closest closest_point(const View& mesh, Vec3 p_m, query::Budget budget, query::Hint& hint) {
  NearBound near_bound;
  if (near_bound.begin(mesh.head(), p_m)) return answer(mesh, near_bound, p_m, budget, hint);
  if (!math::is_finite(p_m)) return answer_nothing(mesh, hint);
  if (!(math::dot(p_m * (1.0f / kBeyond_m), p_m * (1.0f / kBeyond_m)) <= 1.0f))
    return answer_beyond(mesh, p_m, hint);
  FarBound far_bound;
  far_bound.begin(mesh.head(), p_m);
  return answer(mesh, far_bound, p_m, budget, hint);
}

uint64_t probe_hash(const View& mesh, core::Span<const query::ProbePoint> points) {
  core::Hash hash;
  query::Hint hint;
  for (const query::ProbePoint& p : points) {
    const Closest c = closest_point(mesh, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint);
    const float values[] = {c.distance_m,  c.point_m.x,   c.point_m.y,   c.point_m.z,
                            c.direction.x, c.direction.y, c.direction.z, c.certificate.lower_m};
    for (const float value : values) hash.add(math::bits_of(value));
    hash.add(c.triangle);
    hash.add(static_cast<uint32_t>(c.feature));
    hash.add(c.certificate.steps);
  }
  return hash.value();
}

}  // namespace firmtouch::mesh
