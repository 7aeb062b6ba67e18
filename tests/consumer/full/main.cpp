// The library's parts without its controller: a baked mesh; a shape, an effect and a linkage of
// this project's own. The scripted hand rests on each in turn; the program checks the forces and
// exits with 0, or prints what is wrong.
#include "../hand.hpp"
#include "core_xy.hpp"
#include "firmtouch/controller/loaders.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/device/linkage.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/servo/guard.hpp"
#include "firmtouch/servo/step.hpp"
#include "humming_wall.hpp"
#include "torus.hpp"

using namespace firmtouch;

namespace {

constexpr uint32_t kPeriod_us = 1000;
constexpr float kRadius_m = 0.003f;
constexpr float kStiffness_N_per_m = 500.0f;
constexpr query::Budget kBudget{64};
constexpr Torus kTorus{{-0.04f, 0, 0}, 0.02f, 0.008f};
constexpr HummingWall kWall{-0.02f, 0.0005f, kStiffness_N_per_m};
constexpr CoreXY kGantry{0.01f, 0.002f};
// Counts of 10 um.
constexpr device::JointSettings kJoints{3,
                                        {{1000, 0, -10, 10}, {1000, 0, -10, 10}, {200, 0, -50, 50}},
                                        500,
                                        {device::Estimator::kLowPass, 100.0f}};
constexpr device::TorqueLimits kTorques{0.1f, 0.05f, {0.05f, 0.05f, 0.01f}};
constexpr servo::Settings kServo{5.0f, 1000.0f, 0.02f, 0.001f};
constexpr servo::GuardLimits kGuard{5.0f, 1000.0f, 0.001f};

Loaders<asset::Proven, MeshSurface> loaders;
MeshSurface gem_mesh;
device::JointState joints;
scene::MeshTouch gem_touch;
servo::LocalModel model;
servo::State servo_state;
servo::GuardState guard_state;

struct Range {
  float low_N = 1e9f, high_N = -1e9f;  // upwards
  bool sideways = false;
};
Range forces[4];
volatile bool done = false;

void keep(uint32_t tick, const float (&force_N)[3]) {
  bool settled = false;
  const Place place = hand_place(tick, settled);
  if (place == Place::kEnd) done = true;
  if (!settled || place == Place::kEnd) return;
  Range& here = forces[static_cast<int>(place)];
  if (force_N[2] < here.low_N) here.low_N = force_N[2];
  if (force_N[2] > here.high_N) here.high_N = force_N[2];
  if (force_N[0] * force_N[0] + force_N[1] * force_N[1] > 0.0025f) here.sideways = true;
}

void servo_interrupt() {
  static uint32_t tick = 0;
  device::Sample sample{{}, false, 0.001f};
  sample.trusted = hal::encoders_read(sample.counts);
  const device::Joints at = device::read_joints(joints, kJoints, sample);
  const device::Pose pose = pose_of(kGantry, at.angle_rad);

  scene::begin_model(model, pose.position_m, tick, 2);
  scene::MeshObject gem;
  gem.mesh = &gem_mesh.mesh();
  gem.material = {kStiffness_N_per_m, 0};
  scene::touch_mesh(gem, kRadius_m, pose.position_m, kBudget, gem_touch, model);
  scene::add_contact(model, pose.position_m, kRadius_m, closest_on(kTorus, pose.position_m),
                     {kStiffness_N_per_m, 0});
  add_hum(model, kWall, kRadius_m, tick);

  servo::StepInput input;
  input.position_m = pose.position_m;
  input.velocity_mps = device::tip_velocity(pose, at.rate_rad_per_s);
  input.tick = tick;
  input.enable = (hal::motors_lines() & hal::kMotorsEnable) != 0;
  input.reported = at.faults;
  const servo::StepOutput output = servo::step(servo_state, kServo, model, input);
  float force_N[3] = {output.force_N.x, output.force_N.y, output.force_N.z};
  const bool is_good =
      servo::guard(guard_state, input.enable && output.faults == 0, false, force_N);
  hal::motors_state(is_good && output.mode != servo::Mode::kOff);
  // This board's motors take torques.
  const device::JointTorques motors =
      device::torques(pose, kTorques, {force_N[0], force_N[1], force_N[2]});
  hal::motors_write_N(motors.torque_Nm);
  float rendered_N[3];
  force_of(kGantry, motors.torque_Nm, rendered_N);
  keep(tick++, rendered_N);
}

int passed = 0, failed = 0;

bool check(bool holds, const char* text) {
  ++(holds ? passed : failed);
  hal::board_print(holds ? "ok    " : "FAIL  ");
  hal::board_print(text);
  hal::board_print("\n");
  return holds;
}

bool between(Place place, float low_N, float high_N) {
  const Range& here = forces[static_cast<int>(place)];
  return here.low_N >= low_N && here.high_N <= high_N && !here.sideways;
}

}  // namespace

int main() {
  hal::board_begin();
  loaders.begin(hal::board_asset(), {}, gem_mesh);
  while (!loaders.work(kSliceUnits, gem_mesh)) {
  }
  if (!check(loaders.is_ready(), "Asset_LoadsAndItsProbesHaveTheSameBits"))
    return loaders.verdict().rule % 256;
  servo::guard_set_limits(guard_state, kGuard);
  hal::clock_start_servo(kPeriod_us, servo_interrupt);
  while (!done) asm volatile("wfi");

  bool good =
      check(servo_state.faults == 0 && guard_state.armed == servo::kGuardArmed, "Full_HasNoFault");
  good &= check(between(Place::kFree, 0, 0), "FreeSpace_HasNoForce");
  good &= check(between(Place::kOnTorus, 2.45f, 2.55f),
                "OwnShape_IsRendered");  // 500 N/m, 5 mm deep
  good &= check(between(Place::kOnGem, 1.45f, 1.55f), "BakedMesh_IsRendered");   // 3 mm deep
  good &= check(between(Place::kOnWall, 0.24f, 0.76f), "OwnEffect_IsRendered");  // 1 mm, +- 0.5 mm
  const Range& wall = forces[static_cast<int>(Place::kOnWall)];
  good &= check(wall.high_N - wall.low_N > 0.45f, "OwnEffect_Hums");
  char totals[] = "0 passed, 0 failed\n";
  totals[0] = static_cast<char>('0' + passed);
  totals[10] = static_cast<char>('0' + failed);
  hal::board_print(totals);
  return good ? 0 : 1;
}
