#include "firmtouch/hull/triangle_cast.hpp"

#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/triangle_region.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

bool is_finite(const Vec3 (&corner_m)[3]) {
  return math::is_finite(corner_m[0]) && math::is_finite(corner_m[1]) &&
         math::is_finite(corner_m[2]);
}

// Four triangles of the mesh a leaf, handed on in leaf order.
template <class Take>
struct Leaves {
  const View& hull;
  const TriangleRegion& region;
  Take& take;
  float limit = 1;
  bool leaf(uint32_t leaf) {
    const uint32_t first = leaf * kLeafTriangles, count = hull.head().mesh_triangle_count;
    const uint32_t end = first + kLeafTriangles < count ? first + kLeafTriangles : count;
    for (uint32_t i = first; i < end; ++i) {
      const mesh::Triangle<uint32_t> t = hull.triangle(i);
      if (region.crosses(hull.mesh_vertex(t.corner[0]), hull.mesh_vertex(t.corner[1]),
                         hull.mesh_vertex(t.corner[2])) &&
          !take(i))
        return false;
    }
    return true;
  }
};

template <class Take>
bool search(const View& hull, const Vec3 (&corner_m)[3], query::Budget budget, uint32_t& steps,
            Take take) {
  if (!is_finite(corner_m)) return false;
  const mesh::Head& head = hull.mesh_head();
  const Box whole{{head.low_m[0], head.low_m[1], head.low_m[2]},
                  {head.high_m[0], head.high_m[1], head.high_m[2]}};
  const TriangleRegion region(head.low_m, head.high_m, corner_m);
  Leaves<Take> leaves{hull, region, take};
  return descend(hull.boxes(), whole, region, budget.steps == 0 ? 1 : budget.steps, steps, leaves);
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

TriangleHit first_crossed(const View& hull, const Vec3 (&corner_m)[3], query::Budget budget) {
  TriangleHit hit;
  hit.exact = search(hull, corner_m, budget, hit.steps, [&](uint32_t i) {
    if (!hit.hit || i < hit.triangle) hit.triangle = i;
    hit.hit = true;
    return true;
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
  const BaseHullHead& head = base_hull.head();
  const Box whole{{head.low_m[0], head.low_m[1], head.low_m[2]},
                  {head.high_m[0], head.high_m[1], head.high_m[2]}};
  const TriangleRegion region(head.low_m, head.high_m, corner_m);
  const FilledTree tree(base_hull.boxes().size());
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  int32_t winding = 0;
  hit.exact = wind_around(base_hull, corner_m[0], {allowed}, winding, hit.steps);
  hit.hit = !hit.exact || winding != 0;
  uint32_t pending[kMaxTreeDepth + 2] = {}, count = 1;
  while (count > 0 && !hit.hit) {
    const uint32_t node = pending[--count];
    if (region.enter(child_box(whole, base_hull.boxes()[node]), 1.0f) > 1.0f) continue;
    if (hit.steps >= allowed) {
      hit.hit = true;
      hit.exact = false;
      break;
    }
    ++hit.steps;
    if (!tree.is_leaf(node)) {
      pending[count++] = 2 * node + 2;
      pending[count++] = 2 * node + 1;
      continue;
    }
    const BaseHull::Leaf leaf = base_hull.leaf(tree.leaf(node));
    for (uint32_t i = 0; i < leaf.faces.size() && !hit.hit; ++i) {
      hit.hit = region.crosses(vertex(base_hull, leaf.corners[corner_at(leaf.faces[i], 0)]),
                               vertex(base_hull, leaf.corners[corner_at(leaf.faces[i], 1)]),
                               vertex(base_hull, leaf.corners[corner_at(leaf.faces[i], 2)]));
      hit.triangle = leaf.first_face + i;
    }
  }
  return hit;
}

}  // namespace firmtouch::hull
