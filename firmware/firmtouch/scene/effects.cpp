#include "firmtouch/scene/effects.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

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

}  // namespace

float vibration_N(const Vibration& v, uint32_t tick) {
  if (tick < v.start_tick || !is_above_0(v.amplitude_N, servo::kMaxDriveLimit_N)) return 0.0f;
  if (!(v.cycles_a_tick > 0.0f && v.cycles_a_tick < 0.5f)) return 0.0f;
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

}  // namespace firmtouch::scene
