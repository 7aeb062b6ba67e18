#include "firmtouch/hull/base_hull_distance.hpp"

#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

// A squared distance to a box is off by 7 units of 2^-24 (a difference, its square, two sums);
// lowered by more than that.
constexpr float kDown = 1.0f - 0x1p-20f;
constexpr float kBeyond_m = 1e19f;  // squares of more are no floats

float distance2_to(const Box& box, Vec3 p_m) {
  const float at[3] = {p_m.x, p_m.y, p_m.z};
  float sum = 0.0f;
  for (uint32_t k = 0; k < 3; ++k) {
    const float below = box.low_m[k] - at[k], above = at[k] - box.high_m[k];
    const float outside = below > above ? below : above;
    if (outside > 0.0f) sum = sum + outside * outside;
  }
  return sum * kDown;
}

struct Nearest {
  float distance2_m2 = FLT_MAX;
  Vec3 point_m{};
  uint32_t face = UINT32_MAX;
};

// Of a face of no area: none.
Vec3 normal_of(const BaseHull& base_hull, uint32_t face) {
  const Vec3 a = vertex(base_hull, base_hull.vertex_of(face, 0));
  const Vec3 n = cross(vertex(base_hull, base_hull.vertex_of(face, 1)) - a,
                       vertex(base_hull, base_hull.vertex_of(face, 2)) - a);
  const float size = math::length(n);
  return size > 0.0f ? n * (1.0f / size) : Vec3{};
}

void look_at(const BaseHull& base_hull, uint32_t i, Vec3 p_m, Nearest& nearest) {
  Vec3 a = vertex(base_hull, base_hull.vertex_of(i, 0)),
       b = vertex(base_hull, base_hull.vertex_of(i, 1)),
       c = vertex(base_hull, base_hull.vertex_of(i, 2));
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const float ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
  if (bc2 > ab2 && bc2 >= ca2) {  // the solver wants the longest edge first
    const Vec3 first = a;
    a = b, b = c, c = first;
  } else if (ca2 > ab2) {
    const Vec3 first = a;
    a = c, c = b, b = first;
  }
  const mesh::Foot foot = mesh::closest_on_triangle(p_m, a, b, c);
  const Vec3 to_a = p_m - a;
  const bool is_number = foot.distance2_m2 >= 0.0f;  // not of a triangle of no size
  const float distance2 = is_number ? foot.distance2_m2 : dot(to_a, to_a);
  if (!(distance2 < nearest.distance2_m2)) return;
  nearest.distance2_m2 = distance2;
  nearest.face = i;
  nearest.point_m = is_number ? p_m - foot.offset_m : a;
}

struct Pending {
  Box box;
  float distance2_m2;
  uint32_t node;
};

// Result: a lower bound of the squared distance to what was not looked at.
float search(const BaseHull& base_hull, Vec3 p_m, uint32_t allowed, uint32_t& steps,
             Nearest& nearest) {
  const core::Span<const NodeBox> boxes = base_hull.boxes();
  const FilledTree tree(boxes.size());
  const BaseHullHead& head = base_hull.head();
  const Box whole{{head.low_m[0], head.low_m[1], head.low_m[2]},
                  {head.high_m[0], head.high_m[1], head.high_m[2]}};
  Pending pending[kMaxTreeDepth + 2];
  uint32_t count = 1;
  pending[0] = {child_box(whole, boxes[0]), 0.0f, 0};
  pending[0].distance2_m2 = distance2_to(pending[0].box, p_m);
  while (count > 0) {
    if (steps >= allowed) break;
    const Pending now = pending[--count];
    if (now.distance2_m2 >= nearest.distance2_m2) continue;
    ++steps;
    if (tree.is_leaf(now.node)) {
      const uint32_t first = tree.leaf(now.node) * kLeafFaces, all = base_hull.face_count();
      const uint32_t end = first + kLeafFaces < all ? first + kLeafFaces : all;
      for (uint32_t i = first; i < end; ++i) look_at(base_hull, i, p_m, nearest);
      continue;
    }
    const uint32_t left = 2 * now.node + 1;
    Pending one{child_box(whole, boxes[left]), 0.0f, left};
    Pending other{child_box(whole, boxes[left + 1]), 0.0f, left + 1};
    one.distance2_m2 = distance2_to(one.box, p_m);
    other.distance2_m2 = distance2_to(other.box, p_m);
    const bool swap = other.distance2_m2 < one.distance2_m2;
    pending[count++] = swap ? one : other;  // the nearer is taken next
    pending[count++] = swap ? other : one;
  }
  float least = FLT_MAX;
  for (uint32_t i = 0; i < count; ++i)
    if (pending[i].distance2_m2 < least) least = pending[i].distance2_m2;
  return least;
}

// What closest_on_triangle() loses (mesh/loss.hpp), with the longest edge at most the diagonal.
float loss_m(float distance_m, float diagonal_m) {
  return 0x1p-24f * (6.0f * distance_m + 30.0f * diagonal_m) + 0x1p-60f;
}

}  // namespace

BaseHullDistance base_hull_distance(const BaseHull& base_hull, Vec3 p_m, query::Budget budget) {
  BaseHullDistance result;
  const BaseHullHead& head = base_hull.head();
  result.point_m = vertex(base_hull, 0);
  if (!math::is_finite(p_m)) return result;
  int32_t winding = 0;
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  if (wind_around(base_hull, p_m, {allowed}, winding, result.steps))
    result.side = winding == 0 ? BaseHullSide::kOutside : BaseHullSide::kInside;
  Nearest nearest;
  nearest.point_m = result.point_m;
  const float rest2 = search(base_hull, p_m, allowed, result.steps, nearest);
  const bool is_far = !(nearest.distance2_m2 < FLT_MAX);
  result.exact = rest2 >= nearest.distance2_m2 && !is_far;
  result.point_m = nearest.point_m;
  if (nearest.face != UINT32_MAX) result.normal = normal_of(base_hull, nearest.face);
  const Vec3 sides{head.high_m[0] - head.low_m[0], head.high_m[1] - head.low_m[1],
                   head.high_m[2] - head.low_m[2]};
  const float diagonal_m = math::length(sides);
  if (result.side == BaseHullSide::kInside) {
    const float reported_m = math::square_root(nearest.distance2_m2);
    const float deepest_m = reported_m + loss_m(reported_m, diagonal_m);
    if (!is_far) result.deepest_m = deepest_m;
  } else if (result.side == BaseHullSide::kOutside) {
    const float least2 = rest2 < nearest.distance2_m2 ? rest2 : nearest.distance2_m2;
    const float reported_m = least2 < FLT_MAX ? math::square_root(least2) : kBeyond_m;
    const float lower_m = reported_m - loss_m(reported_m, diagonal_m);
    result.lower_m = lower_m > 0.0f ? lower_m : 0.0f;
  }
  return result;
}

}  // namespace firmtouch::hull
