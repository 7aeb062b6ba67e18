// Machines that fail: what each failure does to counts and motors, and that the watch of a run
// notices a controller that goes on.
#include <cmath>
#include <limits>

#include "device/machines.hpp"
#include "harness/test.hpp"
#include "host_sim/bench/failure_run.hpp"
#include "host_sim/plant/machine.hpp"

namespace {

using namespace firmtouch;            // NOLINT: a test file
using namespace firmtouch::host_sim;  // NOLINT

// Three axes of which each moves by its own motor; the first fails after half of the time.
struct Axes {
  Scenario scenario;
  explicit Axes(FailureMode mode) {
    scenario = read_scenario(
        "axes", "asset a.fta\nduration 1 s\nencoder_quantum 1 um\ncoulomb_friction 0 N\n", {},
        parameter_rows());
    Event event;
    event.kind = Event::Kind::kFail;
    event.time_s = 0.05;
    event.failure = {mode, 0};
    scenario.events.push_back(event);
  }
  // Counts of the first two axes before the failure, and at the end.
  struct Ends {
    int32_t before[2], after[2], true_after[2];
    double moved_m[2];  // since the failure
    uint32_t flags_before, flags;
  };
  Ends run() const {
    Machine machine(scenario, {}, {});
    Ends ends{};
    const float push[3] = {0.1f, 0.2f, 0};
    Vec middle_m;
    for (int tick = 0; tick < 100; ++tick) {
      machine.fail_until(tick * 1e-3);
      machine.command(push);
      machine.advance({}, 1e-3);
      if (tick != 48) continue;
      middle_m = machine.position_m();
      ends.flags_before = machine.flags();
      for (int k = 0; k < 2; ++k) ends.before[k] = machine.count(k);
    }
    const Vec end_m = machine.position_m();
    const double at[2] = {end_m.x, end_m.y};
    ends.moved_m[0] = end_m.x - middle_m.x, ends.moved_m[1] = end_m.y - middle_m.y;
    for (int k = 0; k < 2; ++k) {
      ends.after[k] = machine.count(k);
      ends.true_after[k] = static_cast<int32_t>(std::floor(at[k] / 1e-6));
    }
    ends.flags = machine.flags();
    return ends;
  }
};

RunTick tick_of(uint32_t number, float torque_Nm, uint32_t faults) {
  RunTick tick;
  tick.record.input.tick = number;
  tick.record.input.flags = record::kFlagEnable;
  tick.record.output.motor_N[0] = torque_Nm;
  tick.record.output.faults = faults;
  return tick;
}

const tools::LinkageDevice& pantograph() {
  static const tools::LinkageDevice device =
      tools::read_device("haply_pantograph", tools::read_device_text("haply_pantograph"));
  return device;
}

}  // namespace

TEST(Failures_DoToCountsAndMotorsWhatTheyAreCalled) {
  for (uint32_t i = 0; i < kFailureModes; ++i) {
    const FailureMode mode = static_cast<FailureMode>(i);
    const Axes::Ends ends = Axes(mode).run();
    test::note(failure_name(mode), ends.after[0]);
    const bool is_swapped = mode == FailureMode::kEncodersSwapped;
    CHECK_EQ(ends.after[1], ends.true_after[is_swapped ? 0 : 1]);
    CHECK_EQ(ends.flags_before, 0u);
    CHECK_EQ(ends.flags, mode == FailureMode::kEncoderLost ? record::kFlagEncoderFault
                         : mode == FailureMode::kMotorHot  ? record::kFlagDriveFault
                                                           : 0u);
    const bool is_driven = mode != FailureMode::kMotorDead && mode != FailureMode::kMotorReversed;
    CHECK((ends.moved_m[0] > 0.45 * ends.moved_m[1]) == is_driven);
    const int32_t count = ends.after[0], truth = ends.true_after[0];
    if (mode == FailureMode::kEncoderStuck) {
      CHECK(count < truth - 1000 && count >= ends.before[0] && count < ends.before[0] + 500);
    } else if (mode == FailureMode::kEncoderLost) {
      CHECK_EQ(count, 0);
    } else if (is_swapped) {
      CHECK_EQ(count, ends.true_after[1]);
    } else if (mode == FailureMode::kEncoderReversed) {
      CHECK(std::abs(count + truth - 2 * ends.before[0]) < 500 && count < ends.before[0]);
    } else {
      CHECK_EQ(count, truth + (mode == FailureMode::kEncoderSlipped ? 500 : 0));
    }
  }
}

TEST(Failures_ABrokenLinkLeavesTheHandNothing) {
  const std::string machine = "haply_pantograph";
  FailureRig rig(machine, 1);
  const FailureRun run = rig.run({FailureMode::kLinkBroken, 0}, 200);
  CHECK_LE(run.given_J, 1e-4);
  CHECK_GE(rig.run({FailureMode::kMotorReversed, 0}, 200).given_J, 1e-3);
}

TEST(Failures_AJointThatIsNotThere_IsRefused) {
  FailureRig rig("haply_pantograph", 0);
  bool is_refused = false;
  try {
    rig.run({FailureMode::kMotorDead, 2}, 10);
  } catch (const Refused& refused) {
    is_refused = std::string(refused.what()).find("the joints 0 to 1") != std::string::npos;
  }
  CHECK(is_refused);
}

TEST(FailureWatch_NoticesWhatGoesOn) {
  const float most_Nm = pantograph().limits.max_torque_Nm[0];
  const auto watched = [](const std::vector<RunTick>& ticks) {
    FailureWatch watch(pantograph(), 2);
    for (const RunTick& tick : ticks) watch.add(tick);
    return watch.result();
  };
  const float rise_Nm = most_Nm * 0.001f / pantograph().torque_rise_s;
  const FailureRun good =
      watched({tick_of(0, rise_Nm, 0), tick_of(1, 1.9f * rise_Nm, 0), tick_of(2, rise_Nm, 0),
               tick_of(3, rise_Nm, 1), tick_of(4, 0.5f * rise_Nm, 1), tick_of(5, 0, 1)});
  CHECK_EQ(good.to_fault, 1);
  CHECK_EQ(good.to_rest, 2);
  CHECK_EQ(good.not_finite, 0u);
  CHECK_LE(good.torque_share, 1.0);
  CHECK_LE(good.rise_share, 1.0 + 1e-6);
  CHECK_GE(watched({tick_of(0, 1.1f * most_Nm, 0)}).torque_share, 1.09);
  CHECK_GE(watched({tick_of(0, 1.1f * rise_Nm, 0)}).rise_share, 1.09);
  CHECK_GE(watched({tick_of(0, rise_Nm, 0), tick_of(1, -1.1f * rise_Nm, 0)}).rise_share, 1.09);
  std::vector<RunTick> pushing;
  for (uint32_t i = 0; i < 20; ++i) pushing.push_back(tick_of(i, 0.1f * rise_Nm, i < 4 ? 0 : 1));
  CHECK_EQ(watched(pushing).to_rest, 16);
  RunTick nan = tick_of(2, 0, 0);
  nan.record.output.proxy_m[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK_EQ(watched({nan}).not_finite, 1u);
  CHECK_EQ(watched({tick_of(2, 0, 0)}).to_fault, FailureRun::kNever);
}

TEST(FailureWatch_NoticesAMiscountThatSecondEncodersMissed) {
  tools::LinkageDevice device = pantograph();
  device.has_second_encoders = true;
  device.second_within_rad = 0.01f;
  for (float& counts : device.second_counts_per_rad) counts = 1000;
  const auto overdue = [&](double off_rad, uint32_t ticks_off, uint32_t fault_from) {
    FailureWatch watch(device, 1);
    for (uint32_t i = 0; i < 10; ++i) {
      RunTick tick = tick_of(i + 1, 0, i >= fault_from ? 1 : 0);
      tick.encoder_off_rad = i < ticks_off ? off_rad : 0;
      watch.add(tick);
    }
    return watch.result().overdue;
  };
  CHECK_EQ(overdue(0.014, 3, 2), 0u);  // a fault in the third tick
  CHECK_EQ(overdue(0.014, 3, 3), 1u);
  CHECK_EQ(overdue(0.014, 2, 99), 0u);
  CHECK_GE(overdue(0.014, 7, 99), 5u);
  CHECK_EQ(overdue(0.0129, 10, 99), 0u);  // what is not known for certain
}
