#include "firmtouch/servo/guide_line.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::servo {
namespace {

using math::dot;
using math::Vec3;

// The part of an offset or a velocity that the guide acts on.
Vec3 guided_part(const GuideLine& guide, Vec3 a) {
  if (dot(guide.edge, guide.edge) > 0.0f) return guide.edge * dot(guide.edge, a);
  return a - guide.direction * dot(guide.direction, a);
}

}  // namespace

// noinline: in flash once.
[[gnu::noinline]] Vec3 guided_off_m(const GuideLine& guide, Vec3 position_m) {
  const Vec3 off_m = position_m - guide.point_m;
  return dot(guide.edge, off_m) > 0.0f ? Vec3{} : guided_part(guide, off_m);
}

float stretch_m(const GuideLine& guide, Vec3 off_m) {
  return math::larger(math::length(off_m) - guide.tunnel_m, 0.0f);
}

Vec3 pull_N(const GuideLine& guide, Vec3 off_m, Vec3 velocity_mps, float share) {
  const float away_m = math::length(off_m);
  if (!(away_m > guide.tunnel_m)) return {};
  const Vec3 pull = off_m * -(guide.stiffness_N_per_m * share) -
                    guided_part(guide, velocity_mps) * guide.damping_N_s_per_m;
  if (dot(guide.edge, pull) < 0.0f) return {};
  return pull * (1.0f - guide.tunnel_m / away_m);
}

Vec3 drive_N(const GuideLine& guide, Vec3 position_m, Vec3 velocity_mps) {
  const float max_N = guide.drive_limit_N;
  if (!(max_N > 0.0f)) return {};
  const float along_N =
      guide.drive_N -
      guide.drive_stiffness_N_per_m * dot(guide.direction, position_m - guide.point_m) -
      guide.drive_damping_N_s_per_m * dot(guide.direction, velocity_mps);
  return guide.direction * (along_N > max_N ? max_N : along_N < -max_N ? -max_N : along_N);
}

}  // namespace firmtouch::servo
