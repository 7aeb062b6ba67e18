#include "firmtouch/scene/touched.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// Roundings by which the line must leave more of the way than the triangle's own plane. On a joint
// of coplanar triangles both leave nearly the same, and the line turns the proxy aside.
constexpr float kClear = 4.0f;

Tangent from_offset(Vec3 offset_m, float radius_m) {
  const float size_m = math::length(offset_m);
  // Squares of less underflow.
  if (!(size_m > 0x1p-50f)) return {};
  return {offset_m * (1.0f / size_m), size_m - radius_m};
}

// The triangle's own plane; none for a sliver whose height is below `height_m`, because its normal
// is lost to rounding.
Tangent plane_of(const Feature& feature, Vec3 offset_m, float height_m) {
  const Vec3 ab_m = feature.corner[1] - feature.corner[0],
             ac_m = feature.corner[2] - feature.corner[0];
  const Vec3 up_m = ac_m - ab_m * (math::dot(ab_m, ac_m) / math::dot(ab_m, ab_m));
  if (!(math::dot(up_m, up_m) > height_m * height_m)) return {};
  const Vec3 across = math::cross(ab_m, up_m);
  const float size = math::length(across);
  if (!(size > 0x1p-60f)) return {};
  const Vec3 normal = across * (1.0f / size);
  const float distance_m = math::dot(normal, offset_m);
  return distance_m < 0.0f ? Tangent{-normal, -distance_m} : Tangent{normal, distance_m};
}

// Above a face the normal of the triangle is exact to some roundings, while the line to the foot
// loses what the coordinates lose, divided by the distance. Of a sliver it is the other way.
Tangent of_triangle(const Feature& feature, Vec3 x_m, const Outlook& outlook) {
  const mesh::Foot foot =
      mesh::foot_on(x_m, {feature.corner[0], feature.corner[1], feature.corner[2]});
  const Tangent line = from_offset(foot.offset_m, 0.0f);
  const Tangent own = plane_of(feature, foot.offset_m, line.distance_m);
  if (!(own.distance_m > 0.0f)) return line;
  if (foot.feature == mesh::Feature::kFace) return own;
  if (!(own.distance_m >= outlook.radius_m - outlook.rounding_m)) return line;
  const float own_m = own.distance_m + math::dot(own.normal, outlook.way_m),
              line_m = line.distance_m + math::dot(line.normal, outlook.way_m);
  return own_m >= line_m - kClear * outlook.rounding_m ? own : line;
}

}  // namespace

Tangent tangent_at(const Feature& feature, Vec3 x_m, const Outlook& outlook) {
  switch (feature.kind) {
    case Feature::Kind::kTriangle:
      return of_triangle(feature, x_m, outlook);
    case Feature::Kind::kBall:
      return from_offset(x_m - feature.corner[0], feature.corner[1].x);
    case Feature::Kind::kHalfSpace:
      return {feature.corner[1], math::dot(feature.corner[1], x_m - feature.corner[0])};
    case Feature::Kind::kNone:
      break;
  }
  return {{}, FLT_MAX};
}

}  // namespace firmtouch::scene
