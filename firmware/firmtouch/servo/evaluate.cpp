#include "firmtouch/servo/evaluate.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/guide_line.hpp"

namespace firmtouch::servo {
namespace {

using math::dot;
using math::Vec3;

[[gnu::noinline]] bool is_unit(const Vec3& a) {
  return math::is_within(a, 2.0f) && math::is_within(dot(a, a) - 1.0f, 0.02f);
}

[[gnu::noinline]] bool is_near(const Vec3& a) { return math::is_within(a, kMaxPosition_m); }

bool is_material(const float& stiffness_N_per_m, const float& damping_N_s_per_m) {
  return math::is_up_to(stiffness_N_per_m, kMaxStiffness_N_per_m) &&
         math::is_up_to(damping_N_s_per_m, kMaxDamping_N_s_per_m);
}

bool is_sound(const ProxySpring& spring) {
  return is_near(spring.anchor_m) && math::is_within(spring.velocity_mps, kMaxVelocity_mps) &&
         math::is_up_to(spring.reach_m, FLT_MAX) &&
         is_material(spring.stiffness_N_per_m, spring.damping_N_s_per_m);
}

}  // namespace

bool is_sound(const LocalModel& model) {
  if (model.plane_count > kMaxPlanes || !is_near(model.made_at_m)) return false;
  for (uint32_t i = 0; i < model.plane_count; ++i) {
    const ContactPlane& plane = model.plane[i];
    if (!is_unit(plane.normal) || !math::is_within(plane.offset_m, kMaxPosition_m)) return false;
    if (!is_material(plane.stiffness_N_per_m, plane.damping_N_s_per_m)) return false;
  }
  if (!is_sound(model.spring)) return false;
  if (!model.has_guide) return true;
  const GuideLine& guide = model.guide;
  return is_near(guide.point_m) && is_unit(guide.direction) &&
         (math::is_within(guide.edge, 0.0f) || is_unit(guide.edge)) &&
         is_material(guide.stiffness_N_per_m, guide.damping_N_s_per_m) &&
         math::is_up_to(guide.tunnel_m, kMaxTunnel_m) &&
         math::is_within(guide.drive_N, kMaxDrive_N) &&
         is_material(guide.drive_stiffness_N_per_m, guide.drive_damping_N_s_per_m) &&
         math::is_up_to(guide.drive_limit_N, kMaxDriveLimit_N);
}

Vec3 planes_N(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  Vec3 force_N;
  for (uint32_t i = 0; i < model.plane_count; ++i) {
    const ContactPlane& plane = model.plane[i];
    const float depth_m = plane.offset_m - dot(plane.normal, position_m);
    if (!(depth_m > 0.0f)) continue;
    const float push_N = plane.stiffness_N_per_m * depth_m -
                         plane.damping_N_s_per_m * dot(plane.normal, velocity_mps);
    if (push_N > 0.0f) force_N = force_N + plane.normal * push_N;
  }
  return force_N;
}

Vec3 evaluate(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  const Vec3 force_N = planes_N(model, position_m, velocity_mps);
  if (!model.has_guide) return force_N;
  return force_N + pull_N(model.guide, guided_off_m(model.guide, position_m), velocity_mps, 1.0f) +
         drive_N(model.guide, position_m, velocity_mps);
}

}  // namespace firmtouch::servo
