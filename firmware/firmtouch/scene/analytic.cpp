#include "firmtouch/scene/analytic.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// Of all roundings of a distance, relative to it and to the shape's size: coordinates enter only by
// their differences, so it holds far from the origin, too.
constexpr float kRounding = 16.0f * 0x1p-24f;

Near answer(float signed_m, Vec3 outward, float scale_m) {
  Near near;
  near.distance_m = signed_m < 0.0f ? -signed_m : signed_m;
  const float lower_m = near.distance_m - kRounding * (near.distance_m + scale_m);
  near.lower_m = math::larger(lower_m, 0.0f);
  near.sign = signed_m > 0.0f ? 1 : signed_m < 0.0f ? -1 : 0;
  near.outward = outward;
  near.has_inside = true;
  near.is_exact = math::is_finite(signed_m);
  near.steps = near.work = 1;
  return near;
}

Feature ball(Vec3 centre_m, float radius_m) {
  Feature feature;
  feature.corner[0] = centre_m;
  feature.corner[1].x = radius_m;
  feature.kind = Feature::Kind::kBall;
  return feature;
}

// Of a ball about `centre_m`, at `off_m` from there.
Near of_ball(Vec3 off_m, Vec3 centre_m, float radius_m, float scale_m) {
  const float size_m = math::length(off_m);
  const Vec3 outward = size_m > 0.0f ? off_m * (1.0f / size_m) : Vec3{0, 0, 1};
  Near near = answer(size_m - radius_m, outward, scale_m);
  near.feature = ball(centre_m, radius_m);
  return near;
}

// Of a point of the surface.
Near of_point(float signed_m, Vec3 outward, Vec3 point_m, float scale_m) {
  Near near = answer(signed_m, outward, scale_m);
  near.feature = ball(point_m, 0);
  return near;
}
// Of a flat face that is a triangle in it: of a tool that is a point, the line to the nearest point
// is not longer than its rounding. The first two corners are farthest apart.
Feature flat(Vec3 a_m, Vec3 b_m, Vec3 c_m) {
  Feature feature;
  feature.corner[0] = a_m, feature.corner[1] = b_m, feature.corner[2] = c_m;
  feature.kind = Feature::Kind::kTriangle;
  return feature;
}

// A point in the cylinder or box of half extents: where the nearest point of its surface is, in its
// own frame, and the signed distance.
struct Inside {
  float signed_m;
  Vec3 point_m, outward;
  bool is_flat;  // outward is along an axis
};

float clamped(float value, float most) {
  return value > most ? most : value < -most ? -most : value;
}
float sign_of(float value) { return value < 0.0f ? -1.0f : value > 0.0f ? 1.0f : 0.0f; }

Inside of_box(Vec3 p_m, Vec3 half_m) {
  const Vec3 near_m{clamped(p_m.x, half_m.x), clamped(p_m.y, half_m.y), clamped(p_m.z, half_m.z)};
  const Vec3 off_m = p_m - near_m;
  const float size_m = math::length(off_m);
  const Vec3 side{sign_of(off_m.x), sign_of(off_m.y), sign_of(off_m.z)};
  const float sides = math::dot(side, side);
  if (size_m > 0.0f)
    return {size_m, near_m, sides > 1.0f ? off_m * (1.0f / size_m) : side, !(sides > 1.0f)};
  // Inside: the nearest face.
  const float gap[3] = {half_m.x - __builtin_fabsf(p_m.x), half_m.y - __builtin_fabsf(p_m.y),
                        half_m.z - __builtin_fabsf(p_m.z)};
  Vec3 point_m = p_m;
  if (gap[0] <= gap[1] && gap[0] <= gap[2]) {
    point_m.x = p_m.x < 0.0f ? -half_m.x : half_m.x;
    return {-gap[0], point_m, {p_m.x < 0.0f ? -1.0f : 1.0f, 0, 0}, true};
  }
  if (gap[1] <= gap[2]) {
    point_m.y = p_m.y < 0.0f ? -half_m.y : half_m.y;
    return {-gap[1], point_m, {0, p_m.y < 0.0f ? -1.0f : 1.0f, 0}, true};
  }
  point_m.z = p_m.z < 0.0f ? -half_m.z : half_m.z;
  return {-gap[2], point_m, {0, 0, p_m.z < 0.0f ? -1.0f : 1.0f}, true};
}

// Of a box's face, the half that has the point.
Feature half_of_face(const Inside& in, Vec3 half_m) {
  const Vec3 p_m = in.point_m;
  Vec3 low_m = -half_m, high_m = half_m, third_m = low_m;
  if (__builtin_fabsf(in.outward.x) > 0.0f) {
    if (p_m.z * half_m.y > p_m.y * half_m.z)
      third_m.z = half_m.z;
    else
      third_m.y = half_m.y;
    low_m.x = high_m.x = third_m.x = p_m.x;
  } else if (__builtin_fabsf(in.outward.y) > 0.0f) {
    if (p_m.z * half_m.x > p_m.x * half_m.z)
      third_m.z = half_m.z;
    else
      third_m.x = half_m.x;
    low_m.y = high_m.y = third_m.y = p_m.y;
  } else {
    if (p_m.y * half_m.x > p_m.x * half_m.y)
      third_m.y = half_m.y;
    else
      third_m.x = half_m.x;
    low_m.z = high_m.z = third_m.z = p_m.z;
  }
  return flat(low_m, high_m, third_m);
}

// In a disc, about the point at `part` of the radius: a chord half-way between it and the rim, and
// the rim across.
Feature in_disc(Vec3 middle_m, Vec3 radius_m, Vec3 beside_m, float part) {
  const float out = 0.5f + 0.5f * part;
  const Vec3 chord_m = middle_m + radius_m * out;
  const Vec3 half_m = beside_m * math::square_root(math::larger(1.0f - out * out, 0.0f));
  return flat(middle_m - radius_m, chord_m + half_m, chord_m - half_m);
}

// Up to where the sphere on its way is apart from a convex shape that lies behind `reach_m(axis)`
// along any axis, seen from where the way begins. Two convex shapes are apart as long as their
// shadows on one axis are: one that is given, or the one away from the shape's nearest point.
// `extent_m`: the shape's size and the distance of what it is made from.
template <class Reach>
float free_part_before(const Way& way, Vec3 outward, float extent_m, const Reach& reach_m) {
  // Of a product with an axis 4.1 u, of half extents along one 5.2 u; u = 2^-24.
  const float needed_m =
      way.radius_m * (1.0f + 0x1p-20f) + 6.0f * 0x1p-24f * (extent_m + math::length(way.along_m));
  float part = 0;
  for (uint32_t k = 0; k <= way.axes; ++k) {
    const Vec3 axis = k < way.axes ? -way.axis[k] : outward;
    const float room_m = -reach_m(axis) - needed_m;
    const float end_m = -math::dot(axis, way.along_m);
    if (!(room_m >= 0.0f)) continue;
    if (end_m <= room_m) return 1.0f;
    part = math::larger(room_m / end_m * (1.0f - 0x1p-20f), part);
  }
  return part;
}

}  // namespace

Near PlaneTouched::near(Vec3 x_m, query::Budget, float) const {
  const Vec3 off_m = x_m - point_m;
  Near near = answer(math::dot(normal, off_m), normal, math::length(off_m));
  near.feature.corner[0] = point_m;
  near.feature.corner[1] = normal;
  near.feature.kind = Feature::Kind::kHalfSpace;
  return near;
}
float PlaneTouched::free_part(const Way& way, query::Budget, uint32_t& work) const {
  ++work;
  const Vec3 off_m = point_m - way.from_m;
  Way own = way;
  own.axes = 0;  // along others it has no end
  return free_part_before(own, normal, math::length(off_m),
                          [off_m](Vec3 axis) { return math::dot(axis, off_m); });
}

float SphereTouched::size_m() const { return 3.5f * radius_m; }
Near SphereTouched::near(Vec3 x_m, query::Budget, float) const {
  return of_ball(x_m - centre_m, centre_m, radius_m, radius_m);
}
float SphereTouched::free_part(const Way& way, query::Budget budget, uint32_t& work) const {
  return CapsuleTouched{{centre_m, centre_m}, radius_m}.free_part(way, budget, work);
}

float CapsuleTouched::size_m() const { return math::length(end_m[1] - end_m[0]) + 2.0f * radius_m; }
Near CapsuleTouched::near(Vec3 x_m, query::Budget, float) const {
  const Vec3 axis_m = end_m[1] - end_m[0], off_m = x_m - end_m[0];
  const float length2 = math::dot(axis_m, axis_m);
  float t = length2 > 0.0f ? math::dot(off_m, axis_m) / length2 : 0.0f;
  t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
  return of_ball(off_m - axis_m * t, end_m[0] + axis_m * t, radius_m, size_m());
}
float CapsuleTouched::free_part(const Way& way, query::Budget budget, uint32_t& work) const {
  ++work;
  const Vec3 off_m[2] = {end_m[0] - way.from_m, end_m[1] - way.from_m};
  return free_part_before(way, near(way.from_m, budget, 0).outward,
                          2.0f * size_m() + math::length(off_m[0]), [&](Vec3 axis) {
                            return math::larger(math::dot(axis, off_m[0]),
                                                math::dot(axis, off_m[1])) +
                                   radius_m * math::length(axis);
                          });
}

float CylinderTouched::size_m() const {
  return math::length(end_m[1] - end_m[0]) + 2.0f * radius_m;
}
// In the plane of the axis and the point it is a box.
Near CylinderTouched::near(Vec3 x_m, query::Budget, float) const {
  const Vec3 middle_m = (end_m[0] + end_m[1]) * 0.5f, axis_m = end_m[1] - end_m[0];
  const float length_m = math::length(axis_m);
  const Vec3 axis = length_m > 0.0f ? axis_m * (1.0f / length_m) : Vec3{0, 0, 1};
  const Vec3 off_m = ((x_m - end_m[0]) + (x_m - end_m[1])) * 0.5f;
  const float along_m = math::dot(off_m, axis);
  Vec3 across_m = off_m - axis * along_m;
  across_m = across_m - axis * math::dot(across_m, axis);  // what rounding left beside the axis
  const float out_m = math::length(across_m);
  const Vec3 helper = __builtin_fabsf(axis.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 beside = math::cross(axis, helper);
  const Vec3 radial =
      out_m > 0.0f ? across_m * (1.0f / out_m) : beside * (1.0f / math::length(beside));
  const Inside in = of_box({out_m, along_m, 0}, {radius_m, 0.5f * length_m, size_m()});
  Near near = of_point(in.signed_m, radial * in.outward.x + axis * in.outward.y,
                       middle_m + radial * in.point_m.x + axis * in.point_m.y, size_m());
  if (in.is_flat && in.outward.x > 0.0f) {  // the largest ball in it that the point is on
    const float end_gap_m = 0.5f * length_m - __builtin_fabsf(along_m);
    const float ball_m = math::smaller(end_gap_m, radius_m);
    near.feature = ball(middle_m + axis * along_m + radial * (radius_m - ball_m), ball_m);
  } else if (in.is_flat) {
    near.feature = in_disc(middle_m + axis * in.point_m.y, radial * radius_m,
                           math::cross(axis, radial) * radius_m, in.point_m.x / radius_m);
  }
  return near;
}
float CylinderTouched::free_part(const Way& way, query::Budget budget, uint32_t& work) const {
  ++work;
  const Vec3 off_m[2] = {end_m[0] - way.from_m, end_m[1] - way.from_m},
             axis_m = end_m[1] - end_m[0];
  const float length_m = math::length(axis_m);
  const Vec3 own = length_m > 0.0f ? axis_m * (1.0f / length_m) : Vec3{0, 0, 1};
  return free_part_before(way, near(way.from_m, budget, 0).outward,
                          2.0f * size_m() + math::length(off_m[0]), [&](Vec3 axis) {
                            const Vec3 across = axis - own * math::dot(axis, own);
                            return math::larger(math::dot(axis, off_m[0]),
                                                math::dot(axis, off_m[1])) +
                                   radius_m * math::length(across);
                          });
}

float BoxTouched::size_m() const { return 2.0f * math::length(half_m); }
Near BoxTouched::near(Vec3 x_m, query::Budget, float) const {
  const Inside in = of_box(math::apply_inverse(pose, x_m), half_m);
  Near near =
      of_point(in.signed_m, pose.rotation * in.outward, math::apply(pose, in.point_m), size_m());
  if (in.is_flat) {
    near.feature = half_of_face(in, half_m);
    for (Vec3& corner_m : near.feature.corner) corner_m = math::apply(pose, corner_m);
  }
  return near;
}
float BoxTouched::free_part(const Way& way, query::Budget budget, uint32_t& work) const {
  ++work;
  const Vec3 off_m = pose.translation_m - way.from_m;
  return free_part_before(
      way, near(way.from_m, budget, 0).outward, size_m() + math::length(off_m), [&](Vec3 axis) {
        const Vec3 own = math::transposed_times(pose.rotation, axis);
        return math::dot(axis, off_m) + half_m.x * __builtin_fabsf(own.x) +
               half_m.y * __builtin_fabsf(own.y) + half_m.z * __builtin_fabsf(own.z);
      });
}

}  // namespace firmtouch::scene
