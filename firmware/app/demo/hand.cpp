#include "demo/hand.hpp"

#include <float.h>

#include "demo/joints.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/spline/guide/guided_point.hpp"
#include "servo_interrupt.hpp"

// A scripted hand for simulated joints. It follows the asset's guide (without one, a circle about
// the surface), presses and lifts, and closes the enable switch. The motors' forces move it, so
// that a change of a parameter is visible. The rest of the controller program is unchanged.

namespace firmtouch::demo {
namespace {

constexpr float kTwoPi_rad = 6.2831853f;
constexpr float kStep_s = 0.001f;  // of the servo
// A table-top device in a relaxed hand.
constexpr float kMass_kg = 0.075f;
constexpr float kHandStiffness_N_per_m = 400.0f;
constexpr float kDamping_N_s_per_m = 4.5f;
constexpr float kRound_s = 12.0f;     // once along the curve
constexpr float kPress_s = 2.0f;      // from one press to the next
constexpr float kPressDepth = 0.12f;  // of the way from the curve to the middle of the mesh
constexpr float kLiftHeight = 0.06f;
constexpr uint32_t kClose_us = 500000;  // after the start
constexpr uint32_t kOpen_us = 3000000;  // after so long without a force the switch is opened
constexpr uint32_t kRest_us = 3000000;

struct Axis {
  float position_m = 0;
  float velocity_mps = 0;
};

Axis g_axis[3];
uint32_t g_ticks = 0;
bool g_is_closed = false;
bool g_has_switched = false;
uint32_t g_switched_us = 0;

float share_of(float period_s) {
  const uint32_t period = static_cast<uint32_t>(period_s / kStep_s);
  return static_cast<float>(g_ticks % period) / static_cast<float>(period);
}

struct Box {
  float low_m[3] = {}, high_m[3] = {};
};

// Of all objects, where they are.
bool take_objects(const MeshObjects& objects, Box& box) {
  if (!objects.is_open()) return false;
  for (uint32_t k = 0; k < 3; ++k) box.low_m[k] = FLT_MAX, box.high_m[k] = -FLT_MAX;
  for (uint32_t i = 0; i < objects.stored().size(); ++i) {
    const mesh::Head& head = objects.mesh(i).head();
    for (uint32_t corner = 0; corner < 8; ++corner) {
      const auto side = [&](uint32_t k) {
        return (corner >> k & 1u) != 0 ? head.high_m[k] : head.low_m[k];
      };
      const math::RigidTransform& pose = objects.object(i).pose;
      const math::Vec3 t = pose.translation_m;
      float at_m[3] = {t.x, t.y, t.z};
      for (uint32_t k = 0; k < 3; ++k) {
        const math::Vec3 row = pose.rotation.row[k];
        at_m[k] += row.x * side(0) + row.y * side(1) + row.z * side(2);
      }
      for (uint32_t k = 0; k < 3; ++k) {
        if (at_m[k] < box.low_m[k]) box.low_m[k] = at_m[k];
        if (at_m[k] > box.high_m[k]) box.high_m[k] = at_m[k];
      }
    }
  }
  return true;
}

// Of the surface, of any kind; else of the spline guide.
bool find_box(const app::AppController& seen, Box& box) {
  const auto take = [&](const auto& head) {
    for (uint32_t k = 0; k < 3; ++k) {
      box.low_m[k] = head.low_m[k];
      box.high_m[k] = head.high_m[k];
    }
    return true;
  };
  if (take_objects(seen.surface<MeshObjects>(), box)) return true;
  if (seen.mesh().is_open()) return take(seen.mesh().head());
  if (seen.spline_surface().is_open()) return take(seen.spline_surface().head());
  return seen.spline_guide().is_open() && take(seen.spline_guide().model().head());
}

math::Vec3 on_circle(const Box& head) {
  const float angle_rad = kTwoPi_rad * share_of(kRound_s);
  return {0.5f * (head.low_m[0] + head.high_m[0]) +
              0.5f * (head.high_m[0] - head.low_m[0]) * math::cosine(angle_rad),
          0.5f * (head.low_m[1] + head.high_m[1]) +
              0.5f * (head.high_m[1] - head.low_m[1]) * math::sine(angle_rad),
          0.5f * (head.low_m[2] + head.high_m[2])};
}

math::Vec3 along_curve(const curve::View& curve) {
  const core::Span<const curve::Sample> samples = curve.samples();
  const float at = share_of(kRound_s) * static_cast<float>(samples.size() - 1);
  const uint32_t first = static_cast<uint32_t>(at);
  const float rest = at - static_cast<float>(first);
  const curve::Sample& a = samples[first];
  const curve::Sample& b = samples[first + 1 < samples.size() ? first + 1 : first];
  return {a.x_m + (b.x_m - a.x_m) * rest, a.y_m + (b.y_m - a.y_m) * rest,
          a.z_m + (b.z_m - a.z_m) * rest};
}

// The hand's goal: a point of its path, moved in and out.
math::Vec3 goal_m() {
  const app::AppController& seen = app::controller;
  Box head;
  if (!seen.is_ready() || !find_box(seen, head)) return {};
  const math::Vec3 way = seen.curve().is_open() ? along_curve(seen.curve())
                         : seen.spline_guide().is_open()
                             ? spline::point_at_arc(seen.spline_guide(), share_of(kRound_s))
                             : on_circle(head);
  const float swing = math::sine(kTwoPi_rad * share_of(kPress_s));
  const float in = swing > 0 ? kPressDepth * swing : kLiftHeight * swing;
  const math::Vec3 middle{0.5f * (head.low_m[0] + head.high_m[0]),
                          0.5f * (head.low_m[1] + head.high_m[1]),
                          0.5f * (head.low_m[2] + head.high_m[2])};
  return {way.x + (middle.x - way.x) * in, way.y + (middle.y - way.y) * in,
          way.z + (middle.z - way.z) * in};
}

void move(Axis& axis, float motor_N, float goal_m) {
  if (g_ticks == 0) axis.position_m = goal_m;
  const float force_N = motor_N + kHandStiffness_N_per_m * (goal_m - axis.position_m) -
                        kDamping_N_s_per_m * axis.velocity_mps;
  axis.velocity_mps += force_N / kMass_kg * kStep_s;
  axis.position_m += axis.velocity_mps * kStep_s;
}

// Counts of an encoder with the controller's parameters.
// Result: false for NaN, and beyond the range of an encoder.
bool count(const Axis& axis, uint32_t k, int32_t& counts) {
  const params::Values& v = app::controller.values();
  const float scale = v.value[params::kCountsPerMetreX + k];
  const float at = (axis.position_m - v.value[params::kOriginX + k]) * scale;
  counts = 0;
  if (!(at > -1e9f) || !(at < 1e9f)) return false;
  counts = static_cast<int32_t>(at < 0 ? at - 0.5f : at + 0.5f);
  return true;
}

// The switch closes soon after the servo began. Where nothing has pushed for a while, as after a
// fault, it opens, so that faults can be cleared, and closes again.
void work_switch() {
  if (g_ticks == 0) return;
  const uint32_t now_us = hal::clock_us();
  const uint32_t since_us = now_us - g_switched_us;
  if (!g_has_switched) {
    g_has_switched = true;
    g_switched_us = now_us;
  } else if (!g_is_closed && since_us > (joints.pushed_us == 0 ? kClose_us : kRest_us)) {
    g_is_closed = true;
    g_switched_us = now_us;
  } else if (g_is_closed && since_us > kOpen_us && now_us - joints.pushed_us > kOpen_us) {
    g_is_closed = false;
    g_switched_us = now_us;
  }
  joints.lines = g_is_closed ? hal::kMotorsEnable : 0u;
}

}  // namespace

void move_hand() {
  work_switch();
  const math::Vec3 goal = goal_m();
  const float goals_m[3] = {goal.x, goal.y, goal.z};
  for (uint32_t k = 0; k < 3; ++k) move(g_axis[k], joints.motor_N[k], goals_m[k]);
  if (app::controller.is_ready()) ++g_ticks;
  joints.are_valid = true;
  for (uint32_t k = 0; k < 3; ++k)
    joints.are_valid = count(g_axis[k], k, joints.counts[k]) && joints.are_valid;
}

}  // namespace firmtouch::demo
