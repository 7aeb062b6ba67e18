#include "host_sim/bench/failure_study.hpp"

#include <algorithm>
#include <array>
#include <mutex>

#include "batch/parallel.hpp"
#include "device/machines.hpp"
#include "firmtouch/servo/fault.hpp"
#include "host_sim/bench/failure_run.hpp"
#include "host_sim/device/homing_check.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kTouches = 6;
// What SAFETY.md states, at 1 kHz.
constexpr int kMaxTicksToRest = 10, kMaxTicksOfLost = 2, kMaxTicksOfHot = 0;
constexpr double kMaxHoming_s = 2.001;
constexpr double kMaxRise = 1 + 1e-5;  // float rounding
constexpr double kMaxTip_mps = 2;
// Work done on a hand in FailureRig::kTicksAfter, by FailureMode.
constexpr double kStated_J[kFailureModes] = {0.03, 0.01, 0.5,  0.7,   0.03,
                                             0.1,  0.7,  0.01, 0.002, 0.01};

// Of all runs of a failure.
struct Tally {
  uint32_t runs = 0, seen = 0, due = 0;
  uint32_t by[servo::kFaultCount] = {};
  FailureRun worst;  // the worst of each figure; not_finite, overdue: the sum

  void add(const FailureRun& run) {
    Tally one;
    one.runs = 1;
    one.seen = run.to_fault == FailureRun::kNever ? 0 : 1;
    one.due = run.was_due ? 1 : 0;
    for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit) one.by[bit] = run.faults >> bit & 1u;
    one.worst = run;
    add(one);
  }
  void add(const Tally& other) {
    runs += other.runs;
    seen += other.seen;
    due += other.due;
    for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit) by[bit] += other.by[bit];
    const FailureRun& run = other.worst;
    worst.not_finite += run.not_finite;
    worst.overdue += run.overdue;
    worst.to_fault = std::max(worst.to_fault, run.to_fault);
    worst.to_rest = std::max(worst.to_rest, run.to_rest);
    worst.torque_share = std::max(worst.torque_share, run.torque_share);
    worst.rise_share = std::max(worst.rise_share, run.rise_share);
    worst.tip_mps = std::max(worst.tip_mps, run.tip_mps);
    worst.given_J = std::max(worst.given_J, run.given_J);
  }
  std::string faults() const {
    std::string text;
    for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
      if (by[bit] > 0)
        text += (text.empty() ? "" : ", ") + std::to_string(by[bit]) + " " + servo::fault_name(bit);
    return text;
  }
};
using Tallies = std::array<Tally, kFailureModes>;

constexpr HomingCase kInHoming[] = {HomingCase::kDead,      HomingCase::kReversed,
                                    HomingCase::kSwapped,   HomingCase::kNoIndex,
                                    HomingCase::kMotorDead, HomingCase::kMotorReversed};
constexpr uint32_t kHomings = sizeof kInHoming / sizeof kInHoming[0], kSeeds = 8;

// What fails before a homing, and at every `every`th tick of it; below kSeeds, the seeds share the
// ticks.
struct InHoming {
  HomingTally before, later;
};

using InHomings = std::array<InHoming, kHomings>;

void fail_in_homing(const std::string& machine, uint32_t seed, uint32_t every, std::mutex& mutex,
                    InHomings& all) {
  const tools::LinkageDevice device = tools::read_device(machine, tools::read_device_text(machine));
  const auto put = [&](const HomingRun& run, HomingTally& to) {
    const std::lock_guard<std::mutex> lock(mutex);
    add(run, to);
  };
  const double end_s = simulate_homing(device, HomingCase::kGood, seed).seconds;
  for (uint32_t i = 0; i < kHomings; ++i) {
    put(simulate_homing(device, kInHoming[i], seed), all[i].before);
    const uint32_t step = std::max(every, kSeeds);
    for (uint32_t tick = 37 * seed % step; tick * 1e-3 < end_s; tick += step)
      put(simulate_homing(device, kInHoming[i], seed, tick * 1e-3), all[i].later);
  }
}

// Every failure in one touch. A rig is made once: what it bakes takes as long as the runs.
void fail_in_touch(const std::string& machine, uint32_t touch, uint64_t number, uint32_t every,
                   const std::string& only, Tallies& all) {
  FailureRig rig(machine, touch);
  for (uint32_t i = 0; i < kFailureModes; ++i) {
    const auto mode = static_cast<FailureMode>(i);
    if (!only.empty() && only != failure_name(mode)) continue;
    if (mode == FailureMode::kIndexAbsent && !rig.has_index()) continue;
    const uint64_t of_all = (number * (kFailureModes + 1) + i) * kTouches + touch;
    const uint32_t first = static_cast<uint32_t>(37 * of_all % every);  // samples differ
    for (uint32_t tick = first; tick < rig.ticks(); tick += every)
      for (uint32_t joint = 0; joint < rig.joints(); ++joint)
        all[i].add(rig.run({mode, joint}, tick));
  }
}

std::string text_of(double value) { return bench::number_text(value); }

void put(const std::string& machine, const InHomings& homings, bench::Report& report) {
  std::vector<std::vector<std::string>> rows;
  uint32_t homed = 0, wrong = 0;
  double slowest_s = 0, torque_share = 0;
  for (uint32_t i = 0; i < kHomings; ++i) {
    const HomingTally &before = homings[i].before, &later = homings[i].later;
    rows.push_back({case_name(kInHoming[i]), std::to_string(before.runs), causes(before),
                    std::to_string(later.runs), std::to_string(later.homed), causes(later)});
    // A joint with a dead motor may be moved by the others; then it is homed right.
    homed += kInHoming[i] == HomingCase::kMotorDead ? 0 : before.homed;
    wrong += before.wrong + later.wrong;
    slowest_s = std::max({slowest_s, before.slowest_s, later.slowest_s});
    torque_share = std::max({torque_share, before.torque_share, later.torque_share});
  }
  report.table({"fails in homing", "before", "faults", "at a tick", "homed", "faults"}, rows);
  report.bar("homed, though more than a motor was dead", machine, homed, "", 0);
  report.bar("homed more than a count off, or without an end", machine, wrong, "", 0);
  report.bar("the slowest end of homing", machine, slowest_s, "s", kMaxHoming_s);
  report.bar("its largest torque, of the homing torque", machine, torque_share, "", 1);
}

void put(const std::string& machine, const Tallies& tallies, bench::Report& report) {
  std::vector<std::vector<std::string>> rows;
  Tally all;
  double given_share = 0;
  for (uint32_t i = 0; i < kFailureModes; ++i) {
    const Tally& t = tallies[i];
    if (t.runs == 0) continue;
    given_share = std::max(given_share, t.worst.given_J / kStated_J[i]);
    const FailureRun& worst = t.worst;
    rows.push_back({failure_name(static_cast<FailureMode>(i)), std::to_string(t.runs),
                    std::to_string(t.seen), t.seen > 0 ? std::to_string(worst.to_fault) : "",
                    t.seen > 0 ? std::to_string(worst.to_rest) : "", text_of(worst.torque_share),
                    text_of(worst.tip_mps), text_of(1e3 * worst.given_J), t.faults()});
    all.add(t);
  }
  if (all.runs == 0)
    throw Refused(machine + ": it cannot fail so; index_absent needs index pulses in its file");
  report.heading(machine);
  report.table(
      {"failure", "runs", "seen", "ticks to it", "to rest", "torque", "m/s", "mJ given", "faults"},
      rows);
  const Tally& lost = tallies[static_cast<uint32_t>(FailureMode::kEncoderLost)];
  const Tally& hot = tallies[static_cast<uint32_t>(FailureMode::kMotorHot)];
  const auto unseen = [](const Tally& t) { return static_cast<double>(t.runs - t.seen); };
  report.bar("words of outputs that are not finite", machine, all.worst.not_finite, "", 0);
  report.bar("ticks from a fault to motors at rest", machine, all.worst.to_rest, "",
             kMaxTicksToRest);
  report.bar("largest torque, of the joint's largest", machine, all.worst.torque_share, "", 1);
  report.bar("fastest rise of a torque, of the fastest", machine, all.worst.rise_share, "",
             kMaxRise);
  report.bar("work done on the hand, of what SAFETY.md states", machine, given_share, "", 1);
  report.bar("speed of the tip", machine, all.worst.tip_mps, "m/s", kMaxTip_mps);
  report.bar("encoder_lost: ticks to a fault", machine, lost.worst.to_fault, "", kMaxTicksOfLost);
  report.bar("motor_hot: ticks to rest", machine, hot.worst.to_fault + hot.worst.to_rest, "",
             kMaxTicksOfHot);
  report.bar("these two: not seen", machine, unseen(lost) + unseen(hot), "", 0);
  if (all.due == 0) return;
  double given_J = 0;
  for (const FailureMode mode : {FailureMode::kEncoderStuck, FailureMode::kEncodersSwapped,
                                 FailureMode::kEncoderReversed, FailureMode::kEncoderSlipped})
    given_J = std::max(given_J, tallies[static_cast<uint32_t>(mode)].worst.given_J);
  report.figure("the most work that these encoders do on the hand", machine, 1e3 * given_J, "mJ");
  report.figure("encoders off by more than their second ones tolerate", machine, all.due, "runs");
  report.bar("ticks of these beyond what SAFETY.md states, without a fault", machine,
             all.worst.overdue, "", 0);
}

}  // namespace

void study_failures(const std::vector<std::string>& machines, uint32_t every,
                    const std::string& only, const std::function<void(double)>& progress,
                    bench::Report& report) {
  std::vector<Tallies> tallies(machines.size());
  std::vector<InHomings> homing(machines.size());
  std::mutex mutex;
  constexpr uint64_t kJobs = kTouches + kSeeds;  // of a machine
  tools::in_parallel(
      machines.size() * kJobs, tools::processors(),
      [&](uint64_t job) {
        const uint64_t machine = job / kJobs;
        const uint32_t part = static_cast<uint32_t>(job % kJobs);
        if (part >= kTouches) {
          if (only.empty())
            fail_in_homing(machines[machine], part - kTouches + 1, every, mutex, homing[machine]);
          return;
        }
        Tallies of_touch;
        fail_in_touch(machines[machine], part, machine, every, only, of_touch);
        const std::lock_guard<std::mutex> lock(mutex);
        for (uint32_t i = 0; i < kFailureModes; ++i) tallies[machine][i].add(of_touch[i]);
      },
      progress);
  for (size_t i = 0; i < machines.size(); ++i) {
    put(machines[i], tallies[i], report);
    if (only.empty()) put(machines[i], homing[i], report);
  }
}

}  // namespace firmtouch::host_sim
