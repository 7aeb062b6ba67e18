#include "firmtouch/scene/effects.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

constexpr float kHalfTurn_rad = 3.14159265f;
constexpr float kMaxReach_m = 1e5f;
constexpr float kMinLength_m = 1e-6f;
constexpr float kMaxNotches = 1e6f;
constexpr float kAcross = 1e-4f;

bool is_between(float value, float low, float high) { return value >= low && value <= high; }

bool is_above_0(float value, float most) { return value > 0.0f && value <= most; }

bool is_unit(Vec3 a) {
  const float square = math::dot(a, a);
  return square > 0.9999f && square < 1.0001f;
}

// Part of the amplitude.
float envelope(const Vibration& v, uint32_t passed) {
  if (passed < v.rise_ticks) return static_cast<float>(passed) / static_cast<float>(v.rise_ticks);
  passed -= v.rise_ticks;
  if (passed < v.hold_ticks) return 1.0f;
  passed -= v.hold_ticks;
  if (passed >= v.fall_ticks) return 0.0f;
  return 1.0f - static_cast<float>(passed) / static_cast<float>(v.fall_ticks);
}

// Of half the angle of a notch, from the nearest one.
math::SineCosine half_angle(float notches) {
  const float nearest = (notches + 0x1.8p23f) - 0x1.8p23f;
  return math::sine_cosine((notches - nearest) * kHalfTurn_rad);
}

}  // namespace

float vibration_N(const Vibration& v, uint32_t tick) {
  if (!is_above_0(v.amplitude_N, servo::kMaxDriveLimit_N)) return 0.0f;
  if (!(v.cycles_a_tick > 0.0f && v.cycles_a_tick < 0.5f)) return 0.0f;
  const bool is_endless = ((v.rise_ticks | v.hold_ticks | v.fall_ticks) >> 31) != 0;
  if (is_endless && tick < v.start_tick) return 0.0f;
  const uint32_t passed = tick - v.start_tick;
  const uint32_t phase = passed * static_cast<uint32_t>(v.cycles_a_tick * 0x1p32f + 0.5f);
  constexpr float kTurn_rad = 6.28318531f;
  // From -1/2 to 1/2 of a turn, where a float is finer.
  const float angle_rad = static_cast<float>(static_cast<int32_t>(phase)) * (0x1p-32f * kTurn_rad);
  return v.amplitude_N * envelope(v, passed) * math::sine(angle_rad);
}

bool add_vibration(const Vibration& vibration, uint32_t tick, Vec3 position_m,
                   servo::LocalModel& model) {
  const float force_N = vibration_N(vibration, tick);
  if (!is_unit(vibration.direction) || !math::is_within(position_m, servo::kMaxPosition_m))
    return false;
  servo::GuideLine line;
  line.point_m = position_m;
  line.direction = vibration.direction;
  line.drive_N = force_N;
  line.drive_limit_N = force_N < 0.0f ? -force_N : force_N;
  return line.drive_limit_N > 0.0f && add_guide(model, line);
}

// Across the line to the point a spring of constant force is as stiff as force over distance.
bool add_attraction(const Attraction& a, Vec3 position_m, servo::LocalModel& model) {
  const bool is_material = is_above_0(a.stiffness_N_per_m, servo::kMaxStiffness_N_per_m) &&
                           a.damping_N_s_per_m >= 0.0f &&
                           a.damping_N_s_per_m <= servo::kMaxDamping_N_s_per_m &&
                           is_above_0(a.limit_N, servo::kMaxDriveLimit_N);
  if (!is_material || !math::is_within(a.point_m, servo::kMaxPosition_m)) return false;
  const Vec3 off_m = position_m - a.point_m;
  const float away_m = math::length(off_m);
  if (!(away_m < a.reach_m)) return false;
  servo::GuideLine line;
  line.point_m = a.point_m;
  line.direction = away_m > 0x1p-40f ? off_m * (1.0f / away_m) : Vec3{1, 0, 0};
  if (!is_unit(line.direction)) return false;
  line.drive_stiffness_N_per_m = a.stiffness_N_per_m;
  line.drive_limit_N = a.limit_N;
  line.stiffness_N_per_m = a.stiffness_N_per_m;
  if (a.stiffness_N_per_m * away_m > a.limit_N) line.stiffness_N_per_m = a.limit_N / away_m;
  line.damping_N_s_per_m = line.drive_damping_N_s_per_m = a.damping_N_s_per_m;
  return add_guide(model, line);
}

EffectForce attraction_at(const Attraction& a, Vec3 position_m) {
  if (!is_above_0(a.stiffness_N_per_m, servo::kMaxStiffness_N_per_m) ||
      !is_above_0(a.limit_N, servo::kMaxDriveLimit_N) || !is_above_0(a.reach_m, kMaxReach_m) ||
      !math::is_within(a.point_m, servo::kMaxPosition_m) ||
      !math::is_within(position_m, servo::kMaxPosition_m))
    return {};
  const Vec3 off_m = position_m - a.point_m;
  const float away_m = math::length(off_m);
  const bool is_near = away_m < a.reach_m;
  const float stretch_m = is_near ? away_m : a.reach_m;
  const float pull_N = a.stiffness_N_per_m * stretch_m;
  EffectForce effect;
  if (pull_N <= a.limit_N) {
    effect.potential_J = 0.5f * pull_N * stretch_m;
    if (is_near) effect.force_N = off_m * -a.stiffness_N_per_m;
  } else {
    effect.potential_J = a.limit_N * (stretch_m - 0.5f * a.limit_N / a.stiffness_N_per_m);
    if (is_near) effect.force_N = off_m * (-a.limit_N / away_m);
  }
  return effect;
}

EffectForce detents_at(const Detents& d, Vec3 position_m) {
  if (!is_unit(d.direction) || !is_above_0(d.limit_N, servo::kMaxDriveLimit_N) ||
      !is_between(d.pitch_m, kMinLength_m, servo::kMaxPosition_m) ||
      !math::is_within(d.notch_m, servo::kMaxPosition_m) ||
      !math::is_within(position_m, servo::kMaxPosition_m))
    return {};
  const float notches = math::dot(position_m - d.notch_m, d.direction) / d.pitch_m;
  if (!math::is_within(notches, kMaxNotches)) return {};
  const math::SineCosine half = half_angle(notches);
  return {d.direction * (-2.0f * d.limit_N * half.sine * half.cosine),
          d.limit_N * d.pitch_m * (half.sine * half.sine / kHalfTurn_rad)};
}

// With the angle a: around -1 / r dU / da, outward -dU / dr.
EffectForce detents_at(const DetentRing& ring, Vec3 position_m) {
  if (!is_unit(ring.axis) || !is_unit(ring.notch) ||
      !math::is_within(math::dot(ring.axis, ring.notch), kAcross) || ring.count < 2 ||
      ring.count > 1000 || !is_above_0(ring.limit_N, servo::kMaxDriveLimit_N) ||
      !is_between(ring.core_m, kMinLength_m, servo::kMaxPosition_m) ||
      !math::is_within(ring.centre_m, servo::kMaxPosition_m) ||
      !math::is_within(position_m, servo::kMaxPosition_m))
    return {};
  const Vec3 off_m = position_m - ring.centre_m, aside = math::cross(ring.axis, ring.notch);
  const float x_m = math::dot(off_m, ring.notch), y_m = math::dot(off_m, aside);
  const float away_m = math::square_root(x_m * x_m + y_m * y_m);
  if (!(away_m > 0x1p-40f)) return {};
  const float count = static_cast<float>(ring.count);
  const float turns = math::arc_tangent2(y_m, x_m) * (0.5f / kHalfTurn_rad);
  const math::SineCosine half = half_angle(count * turns);
  const bool is_core = away_m < ring.core_m;
  const float w_m = is_core ? away_m * away_m / (2.0f * ring.core_m) : away_m - 0.5f * ring.core_m;
  const float slope = is_core ? away_m / ring.core_m : 1.0f;
  const float square = 2.0f * ring.limit_N / count * half.sine * half.sine;
  const float around_N = -2.0f * ring.limit_N * half.sine * half.cosine * (w_m / away_m);
  const Vec3 outward = (ring.notch * x_m + aside * y_m) * (1.0f / away_m);
  return {math::cross(ring.axis, outward) * around_N - outward * (square * slope), square * w_m};
}

Vec3 speed_wall_N(const SpeedWall& wall, Vec3 velocity_mps) {
  const Viscosity& beyond = wall.beyond;
  if (!is_between(wall.free_mps, 0.0f, servo::kMaxVelocity_mps) ||
      !is_above_0(beyond.damping_N_s_per_m, servo::kMaxDamping_N_s_per_m) ||
      !is_above_0(beyond.limit_N, servo::kMaxDriveLimit_N) ||
      !math::is_within(velocity_mps, servo::kMaxVelocity_mps))
    return {};
  const float speed_mps = math::length(velocity_mps);
  if (!(speed_mps > wall.free_mps)) return {};
  const float wanted_N = beyond.damping_N_s_per_m * (speed_mps - wall.free_mps);
  return velocity_mps * (-(wanted_N < beyond.limit_N ? wanted_N : beyond.limit_N) / speed_mps);
}

Vec3 viscous_N(const Viscosity& viscosity, Vec3 velocity_mps) {
  return speed_wall_N({0.0f, viscosity}, velocity_mps);
}

}  // namespace firmtouch::scene
