// What you feel: a wall in front of an arm of two joints. It is flat, and as hard everywhere,
// although the motors turn joints.
// Picture: pictures/own_linkage.svg
//
// A linkage of your own is two functions around the library's tick: angles to the tool's place, and
// the force on the tool to torques, by the transposed Jacobian (Spong, Hutchinson & Vidyasagar,
// Robot Modeling and Control, 4.10). Everything between them stays as it is.
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr float kUpper_m = 0.12f, kFore_m = 0.10f;  // lengths of the two links
constexpr float kCountsPerTurn = 65536.0f;
constexpr float kTurn_rad = 6.2831853f;
constexpr math::Vec3 kNormal{-0.8f, -0.6f, 0};  // of the wall, to its free side
constexpr float kWall_m = 0.175f;               // away from the shoulder
constexpr float kStiffness_N_per_m = 800.0f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.0f, /*tick_period_s*/ 0.001f};

struct Arm {
  float angle_rad[2];  // shoulder, and elbow beside it

  math::Vec3 elbow_m() const {
    return {kUpper_m * math::cosine(angle_rad[0]), kUpper_m * math::sine(angle_rad[0]), 0};
  }
  math::Vec3 tool_m() const {
    const math::Vec3 elbow = elbow_m();
    const float fore_rad = angle_rad[0] + angle_rad[1];
    return {elbow.x + kFore_m * math::cosine(fore_rad), elbow.y + kFore_m * math::sine(fore_rad),
            0};
  }
  // A joint turns the tool about itself: its torque is the force's moment about the joint.
  void torques(math::Vec3 force_N, float (&torque_Nm)[2]) const {
    const math::Vec3 tool = tool_m(), elbow = elbow_m();
    torque_Nm[0] = tool.x * force_N.y - tool.y * force_N.x;
    torque_Nm[1] = (tool.x - elbow.x) * force_N.y - (tool.y - elbow.y) * force_N.x;
  }
};

Arm arm_at(const int32_t (&counts)[2]) {
  return {{static_cast<float>(counts[0]) * (kTurn_rad / kCountsPerTurn),
           static_cast<float>(counts[1]) * (kTurn_rad / kCountsPerTurn)}};
}

servo::State state;

math::Vec3 tick(uint32_t number, const int32_t (&counts)[2], float (&torque_Nm)[2]) {
  const Arm arm = arm_at(counts);
  const math::Vec3 position_m = arm.tool_m();
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  servo::ContactPlane wall;
  wall.normal = kNormal;
  wall.offset_m = -kWall_m;
  wall.stiffness_N_per_m = kStiffness_N_per_m;
  scene::add_plane(model, wall);
  const servo::StepInput input{position_m, /*velocity_mps*/ {}, number, /*enable*/ true};
  const math::Vec3 force_N = servo::step(state, kSettings, model, input).force_N;
  show(position_m, force_N);
  arm.torques(force_N, torque_Nm);
  return force_N;
}

// Work of the torques in turning joint `k` by one count, less the work of the force in moving the
// tool: 0 for the right torques, whatever the linkage (virtual work).
float missing_J(const int32_t (&counts)[2], uint32_t k, math::Vec3 force_N, float torque_Nm) {
  int32_t before[2] = {counts[0], counts[1]}, behind[2] = {counts[0], counts[1]};
  --before[k];
  ++behind[k];
  const math::Vec3 from_m = arm_at(before).tool_m(), to_m = arm_at(behind).tool_m();
  const float work_J = force_N.x * (to_m.x - from_m.x) + force_N.y * (to_m.y - from_m.y);
  return torque_Nm * 2.0f * kTurn_rad / kCountsPerTurn - work_J;
}

}  // namespace

// The elbow stretches, so that the tool goes through the wall; then the arm swings along it.
int main() {
  bool is_right = true;
  uint32_t touched = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const int32_t step = static_cast<int32_t>(i);
    const int32_t counts[2] = {-4000 + step, step < 2000 ? 20000 - 4 * step : 12000};
    float torque_Nm[2];
    const math::Vec3 force_N = tick(i, counts, torque_Nm);
    const math::Vec3 tool_m = arm_at(counts).tool_m();
    const float depth_m = -kNormal.x * tool_m.x - kNormal.y * tool_m.y - kWall_m;
    if (depth_m > 0) ++touched;
    const float spring_N = depth_m > 0 ? kStiffness_N_per_m * depth_m : 0;
    is_right &= is_near(force_N.x, kNormal.x * spring_N, 1e-3f);
    is_right &= is_near(force_N.y, kNormal.y * spring_N, 1e-3f);
    for (uint32_t k = 0; k < 2; ++k) {
      is_right &= is_near(missing_J(counts, k, force_N, torque_Nm[k]), 0, 2e-6f);
      is_right &= depth_m > 0 || is_near(torque_Nm[k], 0, 1e-6f);
    }
  }
  is_right &= touched > 1000 && touched < 3000;
  return is_right ? 0 : 1;
}
