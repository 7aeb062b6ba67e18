#include "firmtouch/mesh/swept_sphere.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;
using query::SweptSphere;

// Work is counted in eighths of a unit, 28.75 instructions of a Cortex-M7. By its listing a node
// takes at most 69 of them, a triangle 594: what is counted covers each.
constexpr uint32_t kPartsOfUnit = 8;
constexpr uint32_t kBeginParts = 32;
constexpr uint32_t kNodeParts = 3;
constexpr uint32_t kTriangleParts = 21;

// Of NaN nothing is free.
float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }

// A sphere's way against triangles, all seen from where it begins.
struct Passing {
  const SweptSphere& sphere;
  float needed_m;   // between shadows: the radius, and all rounding
  float free_part;  // of the way, of all triangles so far
  float part;       // of this one

  // Any vector is an axis, rounded as it may be, if it is not longer than 1.
  // Result: whether all of the way is free.
  bool is_free(const OfCorners& triangle, Vec3 axis) {
    const float a = math::dot(axis, triangle.a_m), b = math::dot(axis, triangle.b_m),
                c = math::dot(axis, triangle.c_m);
    const float room_m = smaller(a, smaller(b, c)) - needed_m;
    const float end_m = math::dot(axis, sphere.along_m);
    if (!(room_m >= 0.0f)) return false;
    if (end_m <= room_m) return true;
    part = larger(part, room_m / end_m * (1.0f - 0x1p-20f));
    return false;
  }
  void take(const OfCorners& triangle) {
    part = 0;
    for (uint32_t k = 0; k < sphere.axes; ++k)
      if (is_free(triangle, sphere.axis[k])) return;
    // Towards the point of the triangle that is nearest to the begin.
    const Foot foot = foot_on({0.0f, 0.0f, 0.0f}, triangle);
    const float per_m = (0x1p-21f - 1.0f) / math::square_root(foot.distance2_m2);
    if (!is_free(triangle, foot.offset_m * per_m)) free_part = smaller(part, free_part);
  }
};

// From beyond the grid, 0.57 diagonals and more from its centre: whether the ball of two reaches
// about the begin is clear of that about the mesh's box. A tenth of a reach, or where that is less
// the grid's own distance, covers all rounding. NaN, infinite: no.
[[gnu::noinline]] bool is_beyond(const Head& head, const Vec3& from_m, float reach_m) {
  const Vec3 low_m{head.low_m[0], head.low_m[1], head.low_m[2]},
      high_m{head.high_m[0], head.high_m[1], head.high_m[2]};
  const float away_m = math::length((from_m - low_m) + (from_m - high_m));
  return math::is_finite(away_m * reach_m) && away_m > 4.1f * reach_m + head.diagonal_m;
}

}  // namespace

// With u = 2^-24, a product of an axis with a difference of points is off by at most 4.1 u of the
// difference's length. Those of the triangles that matter are at most 2 reaches and an edge long,
// the way is at most 2 reaches: 5 u of 4 reaches and an edge. Other triangles are free.
Sweep sweep(const View& mesh, const SweptSphere& sphere, query::Budget budget) {
  const float radius_m = sphere.radius_m + mesh.head().rounding_m;
  // Of the ball about all of the way.
  const float reach_m = (0.5f * math::length(sphere.along_m) + radius_m) * (1.0f + 0x1p-20f);
  const float rounding_m = 5.0f * 0x1p-24f * (4.0f * reach_m + mesh.head().longest_edge_m);
  Passing passing{sphere, radius_m * (1.0f + 0x1p-20f) + rounding_m, 1.0f, 0.0f};
  NearBound bound;
  uint32_t parts = kBeginParts, count = 0;
  uint32_t pending[kMaxDepth + 2];
  if (bound.begin(mesh.head(), in_box_frame(mesh, sphere.from_m + sphere.along_m * 0.5f)))
    pending[count++] = 0;
  else if (!is_beyond(mesh.head(), sphere.from_m, reach_m))
    passing.free_part = 0.0f;
  const uint32_t prune = bound.prune_key(reach_m * reach_m);
  while (count != 0 && passing.free_part > 0.0f) {
    const uint32_t child = pending[--count];
    uint32_t triangles = is_leaf(child) ? leaf_count(child) : 0;
    parts += kNodeParts + kTriangleParts * triangles;
    if (parts / kPartsOfUnit >= budget.work) {
      passing.free_part = 0.0f;
    } else if (is_leaf(child)) {
      for (uint32_t i = leaf_first(child); triangles != 0; --triangles, ++i) {
        const Triangle<uint32_t> t = mesh.triangle(i);
        passing.take({mesh.vertex(t.corner[0]) - sphere.from_m,
                      mesh.vertex(t.corner[1]) - sphere.from_m,
                      mesh.vertex(t.corner[2]) - sphere.from_m});
      }
    } else {
      for (const Side& side : mesh.nodes()[child].side)
        if (bound.key(side.box) < prune) pending[count++] = side.child;
    }
  }
  const uint32_t used = 1 + parts / kPartsOfUnit;
  return {passing.free_part, used < budget.work ? used : budget.work};
}

}  // namespace firmtouch::mesh
