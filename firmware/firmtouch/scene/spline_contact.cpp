#include "firmtouch/scene/spline_contact.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// At a foot-point inside a surface the line to the tool is along the normal. From this cosine on
// the normal gives the sign.
constexpr float kAlong = 0.98f;
constexpr float kOnSurface = 2e-6f;  // of the extent: no sign nearer than this
constexpr float kLeap =
    0.02f;  // of the extent, added to the radius: a tick that moves farther leaps

struct Offset {
  Vec3 normal;  // to the free side, or 0
  Vec3 off_m;   // from the closest point to the tool
  float size_m = 0;
  float along_m = 0;  // of it along the normal
};

Offset offset_of(const SplineObject& object, const spline::Closest& c, Vec3 p_m) {
  Offset offset;
  offset.normal = object.is_turned ? c.direction * -1.0f : c.direction;
  offset.off_m = p_m - c.point_m;
  offset.size_m = math::length(offset.off_m);
  offset.along_m = math::dot(offset.off_m, offset.normal);
  return offset;
}

// The side that the normal gives; 0 if it is not certain.
int8_t side_by_normal(const Offset& offset) {
  if (offset.along_m >= kAlong * offset.size_m) return 1;
  return offset.along_m <= -kAlong * offset.size_m ? -1 : 0;
}

int8_t side_of_solid(const Offset& offset, bool is_exact, int8_t carried, float extent_m) {
  if (!is_exact) return carried;
  if (!(offset.size_m > kOnSurface * extent_m)) return carried;
  const int8_t side = side_by_normal(offset);
  return side != 0 ? side : carried;
}

// A sheet has no inside: a path round its border gives no sign. From its free side a border is in
// contact, too. A tool is behind the sheet if it came through it and no border was nearest since
// then, however deep it is: a wall does not let go of a hand that presses harder. After a leap the
// path is unknown.
int8_t side_of_sheet(const Offset& offset, bool is_exact, const query::Carried& carried,
                     float radius_m, float extent_m, SplineTouch& touch) {
  const bool is_before = offset.along_m > 0.0f;
  const int8_t by_normal = side_by_normal(offset);
  if (!is_exact) {
    if (!touch.is_from_outside) return 0;
    return is_before ? 1 : by_normal < 0 ? carried.sign : int8_t{0};
  }
  if (is_before && offset.size_m >= radius_m && by_normal > 0) touch.is_from_outside = true;
  const bool is_behind = !is_before && offset.size_m > kOnSurface * extent_m;
  const bool is_leap = !(carried.motion_m <= radius_m + kLeap * extent_m);
  if (is_behind && (by_normal == 0 || is_leap)) touch.is_from_outside = false;
  if (!touch.is_from_outside) return 0;
  return is_behind ? -1 : 1;
}

// Unit normal of the plane; 0 if there is none. The surface's normal where the line to the closest
// point is along it: the position of that point along the surface is ill-conditioned there, and the
// line would shake. At a crease or a border the line, which turns from one normal to the next.
Vec3 contact_normal(const Offset& offset, int8_t side, float extent_m) {
  if (!(offset.size_m > kOnSurface * extent_m)) return offset.normal;
  const float size_m = side > 0 ? offset.size_m : -offset.size_m;
  const Vec3 line = offset.off_m * (1.0f / size_m);
  const float apart = (1.0f - offset.along_m / size_m) * (1.0f / (1.0f - kAlong));
  const float own = apart < 1.0f ? (apart > 0.0f ? apart : 0.0f) : 1.0f;
  const Vec3 mix = line * own + offset.normal * (1.0f - own);
  const float size = math::length(mix);
  return size > 0.1f ? mix * (1.0f / size) : line;
}

}  // namespace

void touch_spline(const SplineObject& object, float radius_m, Vec3 position_m, query::Budget budget,
                  SplineTouch& touch, servo::LocalModel& model) {
  touch.penetration_m = 0;
  touch.normal = {};
  touch.closest = {};
  if (object.surface == nullptr || !object.surface->is_open()) return;
  const Vec3 p_m = math::apply_inverse(object.pose, position_m);
  const query::Carried carried = query::carry(touch.hint, p_m);
  touch.closest = spline::closest_on_surface(*object.surface, p_m, budget, touch.hint);
  query::Certificate& certificate = touch.closest.certificate;
  const Offset offset = offset_of(object, touch.closest, p_m);
  const float extent_m = object.surface->head().extent_m;

  SurfacePoint surface;
  surface.distance_m = touch.closest.distance_m;
  if (object.is_closed) {
    touch.is_from_outside = false;
    surface.sign = side_of_solid(offset, certificate.exact, carried.sign, extent_m);
  } else {
    surface.sign = side_of_sheet(offset, certificate.exact, carried, radius_m, extent_m, touch);
  }
  touch.hint.sign = surface.sign;
  certificate.sign = surface.sign;
  if (surface.sign < 0) {
    if (!certificate.exact) surface.distance_m = certificate.lower_m;
    surface.distance_m = -surface.distance_m;
  }
  if (surface.sign != 0)
    touch.normal = object.pose.rotation * contact_normal(offset, surface.sign, extent_m);
  surface.normal = touch.normal;
  touch.penetration_m = add_contact(model, position_m, radius_m, surface, object.material);
}

}  // namespace firmtouch::scene
