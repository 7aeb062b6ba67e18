#include "firmtouch/scene/analytic.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// Of all roundings of a distance, relative to the coordinates that enter it.
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

// Of a ball about `centre_m`.
Near of_ball(Vec3 x_m, Vec3 centre_m, float radius_m, float scale_m) {
  const Vec3 off_m = x_m - centre_m;
  const float size_m = math::length(off_m);
  const Vec3 outward = size_m > 0.0f ? off_m * (1.0f / size_m) : Vec3{0, 0, 1};
  Near near = answer(size_m - radius_m, outward, scale_m + math::length(centre_m));
  near.feature.corner[0] = centre_m;
  near.feature.corner[1].x = radius_m;
  near.feature.kind = Feature::Kind::kBall;
  return near;
}

// Of a point of the surface.
Near of_point(float signed_m, Vec3 outward, Vec3 point_m, float scale_m) {
  Near near = answer(signed_m, outward, scale_m + math::length(point_m));
  near.feature.corner[0] = point_m;
  near.feature.kind = Feature::Kind::kBall;
  return near;
}

// A point in the cylinder or box of half extents: where the nearest point of its surface is, in its
// own frame, and the signed distance.
struct Inside {
  float signed_m;
  Vec3 point_m, outward;
};

float clamped(float value, float most) {
  return value > most ? most : value < -most ? -most : value;
}

Inside of_box(Vec3 p_m, Vec3 half_m) {
  const Vec3 near_m{clamped(p_m.x, half_m.x), clamped(p_m.y, half_m.y), clamped(p_m.z, half_m.z)};
  const Vec3 off_m = p_m - near_m;
  const float size_m = math::length(off_m);
  if (size_m > 0.0f) return {size_m, near_m, off_m * (1.0f / size_m)};
  // Inside: the nearest face.
  const float gap[3] = {half_m.x - __builtin_fabsf(p_m.x), half_m.y - __builtin_fabsf(p_m.y),
                        half_m.z - __builtin_fabsf(p_m.z)};
  Vec3 point_m = p_m;
  if (gap[0] <= gap[1] && gap[0] <= gap[2]) {
    point_m.x = p_m.x < 0.0f ? -half_m.x : half_m.x;
    return {-gap[0], point_m, {p_m.x < 0.0f ? -1.0f : 1.0f, 0, 0}};
  }
  if (gap[1] <= gap[2]) {
    point_m.y = p_m.y < 0.0f ? -half_m.y : half_m.y;
    return {-gap[1], point_m, {0, p_m.y < 0.0f ? -1.0f : 1.0f, 0}};
  }
  point_m.z = p_m.z < 0.0f ? -half_m.z : half_m.z;
  return {-gap[2], point_m, {0, 0, p_m.z < 0.0f ? -1.0f : 1.0f}};
}

}  // namespace

Near PlaneTouched::near(Vec3 x_m, query::Budget, float) const {
  Near near =
      answer(math::dot(normal, x_m - point_m), normal, math::length(x_m) + math::length(point_m));
  near.feature.corner[0] = point_m;
  near.feature.corner[1] = normal;
  near.feature.kind = Feature::Kind::kHalfSpace;
  return near;
}

float SphereTouched::size_m() const { return 3.5f * radius_m; }
Near SphereTouched::near(Vec3 x_m, query::Budget, float) const {
  return of_ball(x_m, centre_m, radius_m, radius_m);
}

float CapsuleTouched::size_m() const { return math::length(end_m[1] - end_m[0]) + 2.0f * radius_m; }
Near CapsuleTouched::near(Vec3 x_m, query::Budget, float) const {
  const Vec3 axis_m = end_m[1] - end_m[0];
  const float length2 = math::dot(axis_m, axis_m);
  float t = length2 > 0.0f ? math::dot(x_m - end_m[0], axis_m) / length2 : 0.0f;
  t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
  return of_ball(x_m, end_m[0] + axis_m * t, radius_m, size_m());
}

float CylinderTouched::size_m() const {
  return math::length(end_m[1] - end_m[0]) + 2.0f * radius_m;
}
// In the plane of the axis and the point it is a box.
Near CylinderTouched::near(Vec3 x_m, query::Budget, float) const {
  const Vec3 middle_m = (end_m[0] + end_m[1]) * 0.5f, axis_m = end_m[1] - end_m[0];
  const float length_m = math::length(axis_m);
  const Vec3 axis = length_m > 0.0f ? axis_m * (1.0f / length_m) : Vec3{0, 0, 1};
  const Vec3 off_m = x_m - middle_m;
  const float along_m = math::dot(off_m, axis);
  const Vec3 across_m = off_m - axis * along_m;
  const float out_m = math::length(across_m);
  const Vec3 helper = __builtin_fabsf(axis.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 beside = math::cross(axis, helper);
  const Vec3 radial =
      out_m > 0.0f ? across_m * (1.0f / out_m) : beside * (1.0f / math::length(beside));
  const Inside in = of_box({out_m, along_m, 0}, {radius_m, 0.5f * length_m, size_m()});
  return of_point(in.signed_m, radial * in.outward.x + axis * in.outward.y,
                  middle_m + radial * in.point_m.x + axis * in.point_m.y, size_m());
}

float BoxTouched::size_m() const { return 2.0f * math::length(half_m); }
Near BoxTouched::near(Vec3 x_m, query::Budget, float) const {
  const Inside in = of_box(math::apply_inverse(pose, x_m), half_m);
  return of_point(in.signed_m, pose.rotation * in.outward, math::apply(pose, in.point_m),
                  size_m() + math::length(pose.translation_m));
}

}  // namespace firmtouch::scene
