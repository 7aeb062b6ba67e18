#include "firmtouch/scene/spline_touched.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/pose_loss.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// From this cosine on between the normal and the line to the closest point the normal gives the
// sign: within 1.1 degrees. More would take the far face of a sharp edge for the near one, and what
// is beyond that edge for inside.
constexpr float kAlong = 0.9998f;
// What a bound loses to rounding within ten extents, in extents.
constexpr float kMargin = 1e-5f;

int8_t sign_of(const SplineObject& object, const spline::Closest& closest, Vec3 off_m) {
  if (!object.is_closed || !closest.certificate.exact) return 0;
  const float along_m = math::dot(off_m, closest.direction) * (object.is_turned ? -1.0f : 1.0f);
  const float needed_m = kAlong * math::length(off_m);
  if (along_m >= needed_m) return 1;
  return along_m <= -needed_m ? -1 : 0;
}

}  // namespace

float SplineTouched::size_m() const { return object.surface->head().extent_m; }

Near SplineTouched::near(Vec3 x_m, query::Budget budget, float needed_m) const {
  const Vec3 p_m = math::apply_inverse(object.pose, x_m);
  const float loss_m = pose_loss_m(object.pose, x_m);
  // A search that was cut short left no frontier. The next one does only what the move needs.
  if (budget.band_m < FLT_MAX && hint.frontier.outside == 0)
    budget.band_m = needed_m + loss_m + kMargin * size_m();
  const spline::Closest closest = spline::closest_on_surface(*object.surface, p_m, budget, hint);
  const query::Certificate& certificate = closest.certificate;
  Near near;
  near.has_inside = object.is_closed;
  near.lower_m = certificate.lower_m > loss_m ? certificate.lower_m - loss_m : 0.0f;
  near.distance_m = closest.distance_m;
  near.sign = sign_of(object, closest, p_m - closest.point_m);
  near.is_exact = certificate.exact;
  near.steps = certificate.steps;
  near.work = certificate.work;
  near.outward = object.pose.rotation * (object.is_turned ? -closest.direction : closest.direction);
  if (certificate.exact || closest.distance_m <= budget.band_m) {
    near.feature.corner[0] = math::apply(object.pose, closest.point_m);
    near.feature.kind = Feature::Kind::kBall;
  }
  return near;
}

}  // namespace firmtouch::scene
