#include "firmtouch/mesh/swept_sphere.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

// Work is counted in quarters of a unit: a node takes two, a triangle eight.
constexpr uint32_t kPartsOfUnit = 4;
constexpr uint32_t kBeginParts = 16;
constexpr uint32_t kNodeParts = 2;
constexpr uint32_t kTriangleParts = 8;

// Of NaN nothing is free.
float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }

// Words of the box of all of the way, for an overlap of each axis in one subtraction: the other
// way round than Side::box.
struct GridBox {
  uint32_t word[3];

  // Widened by a cell: more than the boxes' slack and all roundings of points that are within four
  // times the grid. False beyond that, or NaN.
  bool begin(const View& mesh, const SweptSphere& sphere, float radius_m) {
    const Head& head = mesh.head();
    const Vec3 a_m = in_box_frame(mesh, sphere.from_m), b_m = in_box_frame(mesh, sphere.to_m);
    const float from[3] = {a_m.x, a_m.y, a_m.z}, to[3] = {b_m.x, b_m.y, b_m.z};
    for (uint32_t k = 0; k < 3; ++k) {
      const float low_m = smaller(from[k], to[k]) - radius_m;
      const float high_m = larger(from[k], to[k]) + radius_m;
      const float low = (low_m - head.grid_low_m[k]) / head.cell_m - 1.0f;
      const float high = (high_m - head.grid_low_m[k]) / head.cell_m + 2.0f;
      if (!(low > -0x1p17f && high < 0x1p17f && low <= high)) return false;
      word[k] = on_grid(high) | (kGridMax - on_grid(low)) << 16 | 0x80008000u;
    }
    return true;
  }
  bool meets(const uint32_t* box) const {
    return ((word[0] - box[0]) & (word[1] - box[1]) & (word[2] - box[2]) & 0x80008000u) ==
           0x80008000u;
  }

 private:
  static uint32_t on_grid(float cells) {
    const float most = static_cast<float>(kGridMax);
    return cells <= 0.0f ? 0u : cells >= most ? kGridMax : static_cast<uint32_t>(cells);
  }
};

float size_of(Vec3 v) { return __builtin_fabsf(v.x) + __builtin_fabsf(v.y) + __builtin_fabsf(v.z); }

// A triangle as seen from where the way begins, and how long the sphere is apart from it.
struct Apart {
  OfCorners corners;
  Vec3 along_m;
  float needed_m;  // rounding of all that follows included
  float part = 0;  // of the way, free as found so far

  // Any vector is an axis, rounded as it may be, if it is not longer than 1. With u = 2^-24 a
  // product of it with a difference of points is off by at most 4.1 u of the sum of their
  // coordinates' sizes; `needed_m` has 5 u of those of all.
  // Result: whether all of the way is free.
  bool on(Vec3 axis) {
    const float a = math::dot(axis, corners.a_m), b = math::dot(axis, corners.b_m),
                c = math::dot(axis, corners.c_m);
    const float room_m = smaller(a, smaller(b, c)) - needed_m, end_m = math::dot(axis, along_m);
    if (!(room_m >= 0.0f)) return false;
    if (end_m <= room_m) return true;
    part = larger(part, room_m / end_m);
    return false;
  }
};

// Result: the part of the way on which the triangle is apart from the sphere.
float free_part(const View& mesh, const SweptSphere& sphere, float radius_m, uint32_t triangle) {
  const Triangle<uint32_t> t = mesh.triangle(triangle);
  const Vec3 a_m = mesh.vertex(t.corner[0]) - sphere.from_m,
             b_m = mesh.vertex(t.corner[1]) - sphere.from_m,
             c_m = mesh.vertex(t.corner[2]) - sphere.from_m;
  Apart apart{{a_m, b_m, c_m}, sphere.to_m - sphere.from_m, 0};
  const float sizes_m = size_of(apart.along_m) + size_of(a_m) + size_of(b_m) + size_of(c_m);
  apart.needed_m = radius_m * (1.0f + 0x1p-20f) + 5.0f * 0x1p-24f * sizes_m;
  for (uint32_t k = 0; k < sphere.axes; ++k)
    if (apart.on(-sphere.axis[k])) return 1.0f;
  // Towards the point of the triangle that is nearest to the begin.
  Foot foot;
  find_foot_apart({0.0f, 0.0f, 0.0f}, apart.corners, Nearer::than_nothing(), foot);
  const float shorter = 1.0f - 0x1p-21f;
  if (apart.on(foot.offset_m * (-shorter / math::square_root(foot.distance2_m2)))) return 1.0f;
  return apart.part * (1.0f - 0x1p-20f);
}

}  // namespace

Sweep sweep(const View& mesh, const SweptSphere& sphere, query::Budget budget) {
  const uint32_t units = budget.work == 0 ? 1 : budget.work;
  const uint32_t allowed = units < UINT32_MAX / kPartsOfUnit ? units * kPartsOfUnit : UINT32_MAX;
  const float radius_m = sphere.radius_m + mesh.head().rounding_m;
  uint32_t parts = kBeginParts, count = 0;
  uint32_t pending[kMaxDepth + 2];
  GridBox way;
  Sweep result;
  if (way.begin(mesh, sphere, radius_m)) {
    result.free_part = 1;
    pending[count++] = 0;
  }
  while (count != 0 && result.free_part > 0.0f) {
    const uint32_t child = pending[--count];
    const uint32_t triangles = is_leaf(child) ? leaf_count(child) : 0;
    parts += is_leaf(child) ? kTriangleParts * triangles : kNodeParts;
    if (parts > allowed) {
      result.free_part = 0;
    } else if (is_leaf(child)) {
      const uint32_t first = leaf_first(child);
      for (uint32_t i = first; i < first + triangles; ++i)
        result.free_part = smaller(result.free_part, free_part(mesh, sphere, radius_m, i));
    } else {
      for (const Side& side : mesh.nodes()[child].side)
        if (way.meets(side.box)) pending[count++] = side.child;
    }
  }
  const uint32_t used = (parts + kPartsOfUnit - 1) / kPartsOfUnit;
  result.work = used < units ? used : units;
  return result;
}

}  // namespace firmtouch::mesh
