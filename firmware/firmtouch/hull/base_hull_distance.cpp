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
constexpr uint32_t kFaceWork = 2;   // beyond the unit of the descent: 300 instructions
constexpr float kBeyond_m = 1e19f;  // squares of more are no floats

// The squared distance of boxes to a point.
struct Around {
  Vec3 p_m;
  float enter(const Box& box, float) const {
    const float at[3] = {p_m.x, p_m.y, p_m.z};
    float sum = 0.0f;
    for (uint32_t k = 0; k < 3; ++k) {
      const float below = box.low_m[k] - at[k], above = at[k] - box.high_m[k];
      const float outside = below > above ? below : above;
      if (outside > 0.0f) sum = sum + outside * outside;
    }
    return sum * kDown;
  }
};

// Of a face of no area: none.
Vec3 normal_of(const BaseHull& base_hull, uint32_t face) {
  const Vec3 a = vertex(base_hull, base_hull.vertex_of(face, 0));
  const Vec3 n = cross(vertex(base_hull, base_hull.vertex_of(face, 1)) - a,
                       vertex(base_hull, base_hull.vertex_of(face, 2)) - a);
  const float size = math::length(n);
  return size > 0.0f ? n * (1.0f / size) : Vec3{};
}

// The nearest point of the faces that were looked at.
struct Nearest {
  const BaseHull& base_hull;
  query::Work& work;
  Vec3 p_m, point_m;
  float distance2_m2 = FLT_MAX;
  float limit = math::float_of(math::bits_of(FLT_MAX) - 1);  // the largest float below distance2_m2
  uint32_t face = UINT32_MAX;

  bool leaf(uint32_t i) {
    const BaseHull::Leaf leaf = base_hull.leaf(i);
    work.charge(kFaceWork * leaf.faces.size());
    for (uint32_t n = 0; n < leaf.faces.size(); ++n)
      look_at(points_of(base_hull, leaf, n), leaf.first_face + n);
    limit = distance2_m2 > 0.0f ? math::float_of(math::bits_of(distance2_m2) - 1) : -1.0f;
    return true;
  }
  void look_at(const FacePoints& corner, uint32_t i);
};

void Nearest::look_at(const FacePoints& corner, uint32_t i) {
  Vec3 a = corner.p_m, b = corner.q_m, c = corner.r_m;
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const float ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
  if (bc2 > ab2 && bc2 >= ca2) {  // the longest edge comes first
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
  if (!(distance2 < distance2_m2)) return;
  distance2_m2 = distance2;
  face = i;
  point_m = is_number ? p_m - foot.offset_m : a;
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
  query::Work work(budget);
  if (wind_around(base_hull, p_m, work, winding))
    result.side = winding == 0 ? BaseHullSide::kOutside : BaseHullSide::kInside;
  Nearest nearest{base_hull, work, p_m, result.point_m};
  const query::Descent<float> end =
      descend<false>(base_hull.boxes(), box_of(head), Around{p_m}, work, nearest);
  result.steps = work.visits();
  result.work = work.used();
  const float rest2 = end.is_done ? FLT_MAX : end.pending;
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
    result.lower_m = math::larger(lower_m, 0.0f);
  }
  return result;
}

}  // namespace firmtouch::hull
