#include "firmtouch/scene/spline_contact.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// At a foot-point inside a surface the line to it is along the normal; so near to it, a side is told.
constexpr float kAlong = 0.98f;
constexpr float kOnSurface = 2e-6f;  // of the extent: no side
// A tick that goes this far, of the extent and beside the radius, leaps.
constexpr float kLeap = 0.02f;

struct Place {
  Vec3 normal;  // to the free side, or 0
  Vec3 off_m;   // from the closest point to the tool
  float size_m = 0;
  float along_m = 0;  // of it along the normal
};

Place place_of(const SplineObject& object, const spline::Closest& c, Vec3 p_m) {
  Place place;
  place.normal = object.is_turned ? c.direction * -1.0f : c.direction;
  place.off_m = p_m - c.point_m;
  place.size_m = math::length(place.off_m);
  place.along_m = math::dot(place.off_m, place.normal);
  return place;
}

// By the normal where that is certain; 0 where it is not.
int8_t side_by_normal(const Place& place) {
  if (place.along_m >= kAlong * place.size_m) return 1;
  return place.along_m <= -kAlong * place.size_m ? -1 : 0;
}

int8_t side_of_solid(const Place& place, bool is_exact, int8_t carried, float extent_m) {
  if (!is_exact) return carried;
  if (!(place.size_m > kOnSurface * extent_m)) return carried;
  const int8_t side = side_by_normal(place);
  return side != 0 ? side : carried;
}

// A sheet has no inside, so that a way round its border tells no side. From its free side a border
// is felt too. Behind it is a tool that came through it, from one tick to the next, and since then has
// not been where a border was the nearest: no matter how deep, for a wall does not let go of a hand that
// presses harder. Where a tick leaped it is not known which way it went.
int8_t side_of_sheet(const Place& place, bool is_exact, const query::Carried& carried,
                     float radius_m, float extent_m, SplineTouch& touch) {
  const bool is_before = place.along_m > 0.0f;
  const int8_t by_normal = side_by_normal(place);
  if (!is_exact) {
    if (!touch.is_ahead) return 0;
    return is_before ? 1 : by_normal < 0 ? carried.sign : int8_t{0};
  }
  if (is_before && place.size_m >= radius_m && by_normal > 0) touch.is_ahead = true;
  const bool is_behind = !is_before && place.size_m > kOnSurface * extent_m;
  const bool is_leap = !(carried.motion_m <= radius_m + kLeap * extent_m);
  if (is_behind && (by_normal == 0 || is_leap)) touch.is_ahead = false;
  if (!touch.is_ahead) return 0;
  return is_behind ? -1 : 1;
}

// Unit normal of the plane; 0 where there is none. The surface's own where the line to the closest
// point is along it: the distance hardly tells where along the surface that point lies, so that the
// line would shake; and the line at a crease or a border, where it turns from one normal to the next.
Vec3 contact_normal(const Place& place, int8_t side, float extent_m) {
  if (!(place.size_m > kOnSurface * extent_m)) return place.normal;
  const float size_m = side > 0 ? place.size_m : -place.size_m;
  const Vec3 line = place.off_m * (1.0f / size_m);
  const float apart = (1.0f - place.along_m / size_m) * (1.0f / (1.0f - kAlong));
  const float own = apart < 1.0f ? (apart > 0.0f ? apart : 0.0f) : 1.0f;
  const Vec3 mix = line * own + place.normal * (1.0f - own);
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
  touch.closest = spline::closest_point(*object.surface, p_m, budget, touch.hint);
  query::Certificate& certificate = touch.closest.certificate;
  const Place place = place_of(object, touch.closest, p_m);
  const float extent_m = object.surface->head().extent_m;

  SurfacePoint surface;
  surface.lower_m = certificate.lower_m;
  surface.distance_m = touch.closest.distance_m;
  if (object.is_closed) {
    touch.is_ahead = false;
    surface.sign = side_of_solid(place, certificate.exact, carried.sign, extent_m);
  } else {
    surface.sign = side_of_sheet(place, certificate.exact, carried, radius_m, extent_m, touch);
  }
  touch.hint.sign = surface.sign;
  certificate.sign = surface.sign;
  if (surface.sign < 0) {
    if (!certificate.exact) surface.distance_m = certificate.lower_m;
    surface.distance_m = -surface.distance_m;
  }
  if (surface.sign != 0)
    touch.normal = object.pose.rotation * contact_normal(place, surface.sign, extent_m);
  surface.normal = touch.normal;
  touch.penetration_m = add_contact(model, position_m, radius_m, surface, object.material);
}

}  // namespace firmtouch::scene
