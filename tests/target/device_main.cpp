// Instructions from counts to position, velocity, Jacobian and torques, by linkage. A row each:
//     NAME | JOINTS | POSE | VELOCITY, TORQUES | MEAN OF ALL | WORST | % OF TICKS WITH WHOLE FORCE
// and of homing:   homing | MEAN | WORST | 1 if it was done
// tools/bench/cortex-m7-device runs it.
#include <stdint.h>

#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/homing.hpp"
#include "firmtouch/device/serial_arm.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "target/count.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

constexpr uint32_t kTicks = 2000;
constexpr float kCountsPerRad = 2200.0f;  // 13,824 a turn
const device::FiveBar kFiveBar{.025f, {.063f, .063f}, {.075f, .075f}, true};
const device::SerialArm kScara{2, {.15f, .12f}, 0, 0, false};
const device::SerialArm kArm{3, {.13f, .12f}, .02f, .1f, false};
const device::Delta kDelta{{.06f, .06f, .06f}, {.103f, .103f, .103f}, .038f, .021f, .0045f, true};
const device::TorqueLimits kLimits;
volatile float g_kept;

// Joints that swing by a quarter of a turn about `middle_rad`, at speeds in no ratio.
template <class Linkage>
void run(const char* name, const Linkage& linkage, uint32_t joints, const float (&middle_rad)[3]) {
  device::JointSettings settings;
  settings.joints = joints;
  for (uint32_t k = 0; k < 3; ++k) settings.joint[k] = {kCountsPerRad, middle_rad[k], -7, 7};
  device::JointState state;
  const uint32_t empty = target::empty_work();
  uint64_t parts[3] = {}, sum = 0;
  uint32_t worst = 0, reachable = 0;
  for (uint32_t i = 0; i < kTicks; ++i) {
    device::Sample sample{{}, true, 1e-3f};
    for (uint32_t k = 0; k < joints; ++k) {
      const int32_t step = static_cast<int32_t>(i * (11 + 3 * k) % 6912) - 3456;  // a sawtooth
      sample.counts[k] = (step < 0 ? -step : step) - 1728;
    }
    const uint32_t start = hal::clock_work();
    const device::Joints at = read_joints(state, settings, sample);
    const uint32_t read = hal::clock_work();
    const device::Pose pose = pose_of(linkage, at.angle_rad);
    const uint32_t posed = hal::clock_work();
    const math::Vec3 velocity = tip_velocity(pose, at.rate_rad_per_s);
    const device::JointTorques out = torques(pose, kLimits, {1, 2, 3});
    const uint32_t end = hal::clock_work();
    g_kept = velocity.x + out.torque_Nm[0];
    reachable += pose.is_reachable && pose.reciprocal_condition > kLimits.full_from ? 1 : 0;
    parts[0] += read - start - empty;
    parts[1] += posed - read - empty;
    parts[2] += end - posed - empty;
    const uint32_t all = end - start - 3 * empty;
    sum += all;
    worst = all > worst ? all : worst;
  }
  hal::board_print(name);
  for (const uint64_t part : parts) target::print(" | ", target::instructions(part / kTicks));
  target::print(" | ", target::instructions(sum / kTicks));
  target::print(" | ", target::instructions(worst));
  target::print(" | ", reachable * 100 / kTicks);
  hal::board_print("\n");
}

// Three joints between stops that follow their torques at once.
void run_homing() {
  device::JointSettings joints;
  device::HomingSettings settings;
  settings.by = device::HomeBy::kIndex;
  for (uint32_t k = 0; k < 3; ++k) {
    joints.joint[k] = {kCountsPerRad, 0, -0.5f, 0.5f};
    settings.torque_Nm[k] = 0.1f;
    settings.index_period_rad[k] = 0.4f;
  }
  device::HomingState state;
  device::HomingSample sample;
  sample.encoders = {{}, true, 1e-3f};
  const uint32_t empty = target::empty_work();
  uint64_t sum = 0;
  uint32_t worst = 0, ticks = 0;
  while (!state.is_done && ticks < kTicks) {
    const uint32_t start = hal::clock_work();
    const device::HomingTorques out = home(state, settings, joints, sample);
    const uint32_t all = hal::clock_work() - start - empty;
    sum += all;
    worst = all > worst ? all : worst;
    ++ticks;
    sample.pulses = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const int32_t way = out.torque_Nm[k] > 0 ? 10 : out.torque_Nm[k] < 0 ? -10 : 0;
      const int32_t to = sample.encoders.counts[k] + way;
      if (to > 1100 || to < -1100) continue;
      if (to == 0) sample.pulses |= 1u << k;  // latched at 0, an index pulse's angle
      sample.encoders.counts[k] = to;
    }
  }
  hal::board_print("homing");
  target::print(" | ", target::instructions(sum / ticks));
  target::print(" | ", target::instructions(worst));
  target::print(" | ", state.is_done ? 1 : 0);
  hal::board_print("\n");
}

}  // namespace

int main() {
  hal::board_begin();
  run("five-bar", kFiveBar, 2, {2.1f, 1.0f, 0});
  run("serial, 2 joints", kScara, 2, {.5f, 1.2f, 0});
  run("serial, 3 joints", kArm, 3, {.1f, .8f, -1.6f});
  run("delta", kDelta, 3, {.4f, .4f, .4f});
  run_homing();
  return 0;
}
