#include "firmtouch/scene/compose.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

float depth_at(const servo::ContactPlane& plane, math::Vec3 position_m) {
  return plane.offset_m - math::dot(plane.normal, position_m);
}

uint32_t shallowest(const servo::LocalModel& model) {
  uint32_t least = 0;
  for (uint32_t i = 1; i < servo::kMaxPlanes; ++i) {
    if (depth_at(model.plane[i], model.made_at_m) < depth_at(model.plane[least], model.made_at_m))
      least = i;
  }
  return least;
}

}  // namespace

void begin_model(servo::LocalModel& model, math::Vec3 position_m, uint32_t tick,
                 uint32_t age_ticks) {
  // What is not used is not cleared.
  model.plane_count = 0;
  model.spring = {};
  model.has_guide = model.is_uncertain = model.is_squeezed = false;
  model.made_at_m = position_m;
  ++model.sequence;
  model.made_tick = tick;
  model.expires_tick = tick + age_ticks;
}

bool add_plane(servo::LocalModel& model, const servo::ContactPlane& plane) {
  if (model.plane_count >= servo::kMaxPlanes) return false;
  model.plane[model.plane_count++] = plane;
  return true;
}

bool add_guide(servo::LocalModel& model, const servo::GuideLine& guide) {
  if (model.has_guide) return false;
  model.guide = guide;
  model.has_guide = true;
  return true;
}

float add_contact(servo::LocalModel& model, math::Vec3 position_m, float radius_m,
                  const SurfacePoint& surface, const Material& material) {
  if (surface.sign == 0) return 0.0f;
  if (!math::is_about_unit(surface.normal)) return 0.0f;
  const float depth_m = radius_m - surface.distance_m;
  servo::ContactPlane plane;
  plane.normal = surface.normal;
  // From the tool's own position, not the surface's: the depth at this position keeps its last
  // digits.
  plane.offset_m = math::dot(surface.normal, position_m) + depth_m;
  plane.stiffness_N_per_m = material.stiffness_N_per_m;
  plane.damping_N_s_per_m = material.damping_N_s_per_m;
  if (!math::is_finite(plane.offset_m)) return 0.0f;
  if (!add_plane(model, plane)) {
    const uint32_t least = shallowest(model);
    if (!(depth_m > depth_at(model.plane[least], model.made_at_m))) return 0.0f;
    model.plane[least] = plane;
  }
  return depth_m > 0.0f ? depth_m : 0.0f;
}

}  // namespace firmtouch::scene
