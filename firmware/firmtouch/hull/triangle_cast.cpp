#include "firmtouch/hull/triangle_cast.hpp"

#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/triangle_region.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

// Four triangles of the mesh a leaf, handed on in leaf order.
template <class Take>
struct Leaves {
  const View& hull;
  const TriangleRegion& region;
  Take& take;
  float limit = 1;
  bool leaf(uint32_t leaf) {
    return each_triangle(
        hull, leaf, [&](uint32_t i) { return !region.crosses(points_of(hull, i)) || take(i); });
  }
};

template <class Take>
bool search(const View& hull, const Vec3 (&corner_m)[3], query::Budget budget, uint32_t& steps,
            Take take) {
  if (!is_finite(corner_m)) return false;
  const TriangleRegion region(box_of(hull.mesh_head()), corner_m);
  Leaves<Take> leaves{hull, region, take};
  query::Work work(budget);
  const bool is_done =
      descend<true>(hull.boxes(), box_of(hull.mesh_head()), region, work, leaves).is_done;
  steps = work.visits();
  return is_done;
}

}  // namespace

TriangleHit any_crossed(const View& hull, const Vec3 (&corner_m)[3], query::Budget budget) {
  TriangleHit hit;
  hit.exact = search(hull, corner_m, budget, hit.steps, [&](uint32_t i) {
    hit.hit = true;
    hit.triangle = i;
    return false;
  });
  return hit;
}

TriangleHits all_crossed(const View& hull, const Vec3 (&corner_m)[3], query::Budget budget,
                         core::Span<uint32_t> buffer) {
  TriangleHits hits;
  hits.exact = search(hull, corner_m, budget, hits.steps, [&](uint32_t i) {
    ++hits.found;
    uint32_t at = hits.reported;
    if (at < buffer.size()) {
      ++hits.reported;
    } else if (at == 0 || buffer[at - 1] < i) {
      return true;
    } else {
      --at;  // the last one gives way
    }
    for (; at > 0 && buffer[at - 1] > i; --at) buffer[at] = buffer[at - 1];
    buffer[at] = i;
    return true;
  });
  return hits;
}

TriangleHit base_hull_crossed(const BaseHull& base_hull, const Vec3 (&corner_m)[3],
                              query::Budget budget) {
  TriangleHit hit;
  if (!is_finite(corner_m)) return hit;
  const TriangleRegion region(box_of(base_hull.head()), corner_m);
  int32_t winding = 0;
  query::Work work(budget);
  hit.exact = wind_around(base_hull, corner_m[0], work, winding);
  hit.hit = !hit.exact || winding != 0;
  hit.steps = work.visits();
  if (hit.hit) return hit;
  hit.exact = faces_near(base_hull, region, work, [&](const BaseHull::Leaf& leaf, uint32_t n) {
    hit.hit = region.crosses(points_of(base_hull, leaf, n));
    hit.triangle = leaf.first_face + n;
    return !hit.hit;
  });
  hit.hit = hit.hit || !hit.exact;
  hit.steps = work.visits();
  return hit;
}

}  // namespace firmtouch::hull
