#include "firmtouch/servo/evaluate.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::servo {
namespace {

using math::dot;
using math::Vec3;

bool is_between(float value, float low, float high) { return value >= low && value <= high; }

[[gnu::noinline]] bool is_unit(Vec3 a) {
  return math::is_within(a, 2.0f) && is_between(dot(a, a), 0.98f, 1.02f);
}

[[gnu::noinline]] bool is_near(Vec3 a) { return math::is_within(a, kMaxPosition_m); }

bool is_material(float stiffness_N_per_m, float damping_N_s_per_m) {
  return is_between(stiffness_N_per_m, 0.0f, kMaxStiffness_N_per_m) &&
         is_between(damping_N_s_per_m, 0.0f, kMaxDamping_N_s_per_m);
}

Vec3 across(Vec3 a, Vec3 direction) { return a - direction * dot(direction, a); }

// Spring and damper across the line. None within a tunnel; beyond it both grow with the share of
// the distance that lies outside.
Vec3 pull_N(const GuideLine& guide, Vec3 off_m, Vec3 velocity_mps) {
  Vec3 pull = across(off_m, guide.direction) * -guide.stiffness_N_per_m -
              across(velocity_mps, guide.direction) * guide.damping_N_s_per_m;
  if (guide.tunnel_m > 0.0f) {
    const float away_m = math::length(across(off_m, guide.direction));
    const float share = away_m > guide.tunnel_m ? 1.0f - guide.tunnel_m / away_m : 0.0f;
    pull = pull * share;
  }
  return pull;
}

Vec3 drive_N(const GuideLine& guide, Vec3 off_m, Vec3 velocity_mps) {
  const float max_N = guide.drive_limit_N;
  if (!(max_N > 0.0f)) return {};
  const float along_N = guide.drive_N -
                        guide.drive_stiffness_N_per_m * dot(guide.direction, off_m) -
                        guide.drive_damping_N_s_per_m * dot(guide.direction, velocity_mps);
  return guide.direction * (along_N > max_N ? max_N : along_N < -max_N ? -max_N : along_N);
}

bool is_sound(const ProxySpring& spring) {
  return is_near(spring.anchor_m) && math::is_within(spring.velocity_mps, kMaxVelocity_mps) &&
         is_between(spring.reach_m, 0.0f, FLT_MAX) &&
         is_material(spring.stiffness_N_per_m, spring.damping_N_s_per_m);
}

}  // namespace

bool is_sound(const LocalModel& model) {
  if (model.plane_count > kMaxPlanes || !is_near(model.made_at_m)) return false;
  if (!is_between(model.free_radius_m, 0.0f, FLT_MAX)) return false;
  for (uint32_t i = 0; i < model.plane_count; ++i) {
    const ContactPlane& plane = model.plane[i];
    if (!is_unit(plane.normal) || !math::is_within(plane.offset_m, kMaxPosition_m)) return false;
    if (!is_material(plane.stiffness_N_per_m, plane.damping_N_s_per_m)) return false;
  }
  if (!is_sound(model.spring)) return false;
  if (!model.has_guide) return true;
  const GuideLine& guide = model.guide;
  return is_near(guide.point_m) && is_unit(guide.direction) &&
         is_material(guide.stiffness_N_per_m, guide.damping_N_s_per_m) &&
         is_between(guide.tunnel_m, 0.0f, kMaxTunnel_m) &&
         math::is_within(guide.drive_N, kMaxDrive_N) &&
         is_material(guide.drive_stiffness_N_per_m, guide.drive_damping_N_s_per_m) &&
         is_between(guide.drive_limit_N, 0.0f, kMaxDriveLimit_N);
}

Vec3 evaluate(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  Vec3 force_N;
  for (uint32_t i = 0; i < model.plane_count; ++i) {
    const ContactPlane& plane = model.plane[i];
    const float depth_m = plane.offset_m - dot(plane.normal, position_m);
    if (!(depth_m > 0.0f)) continue;
    const float push_N = plane.stiffness_N_per_m * depth_m -
                         plane.damping_N_s_per_m * dot(plane.normal, velocity_mps);
    if (push_N > 0.0f) force_N = force_N + plane.normal * push_N;
  }
  if (model.has_guide) {
    const Vec3 off_m = position_m - model.guide.point_m;
    force_N = force_N + pull_N(model.guide, off_m, velocity_mps) +
              drive_N(model.guide, off_m, velocity_mps);
  }
  return force_N;
}

}  // namespace firmtouch::servo
