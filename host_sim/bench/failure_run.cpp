#include "host_sim/bench/failure_run.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>

#include "device/machines.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr int kTicksAtRest = 5;  // after which a run ends

double wide(float a) { return static_cast<double>(a); }

}  // namespace

FailureWatch::FailureWatch(const tools::LinkageDevice& device, uint32_t from_tick)
    : device_(device), from_tick_(from_tick) {
  // They are aligned at the first sample: what failed before is not seen until joints move.
  if (!device.has_second_encoders || from_tick == 0) return;
  constexpr double kCounts = 3;  // by which encoders and comparison are uncertain
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const double first = std::fabs(wide(device.joints.joint[k].counts_per_rad));
    const double second = std::fabs(wide(device.second_counts_per_rad[k]));
    tolerated_rad_ =
        std::max(tolerated_rad_, wide(device.second_within_rad) + kCounts / second + 1 / first);
  }
}

void FailureWatch::add_miscount(double off_rad, bool may_go_on) {
  if (!(tolerated_rad_ > 0)) return;
  off_history_ = off_history_ << 1 | (off_rad > tolerated_rad_ ? 1u : 0u);
  const bool is_due = (off_history_ & 7u) == 7u || std::bitset<32>(off_history_).count() >= 6;
  run_.was_due |= is_due;
  if (is_due && !may_go_on) ++run_.overdue;
}

bool FailureWatch::add(const RunTick& tick) {
  const record::TickOutput& out = tick.record.output;
  const uint32_t now = tick.record.input.tick;
  add_torques(out);
  if (now < from_tick_) {
    begin_J_ = tick.hand_J;
    return false;
  }
  // Faults are latched while the motors are to be on.
  const bool enables = (tick.record.input.flags & record::kFlagEnable) != 0;
  if (!enables) from_tick_ = now + 1;
  add_words(tick.record);
  add_miscount(tick.encoder_off_rad, !enables || (run_.faults | out.faults) != 0);
  run_.tip_mps = std::max(run_.tip_mps, norm(tick.device_mps));
  run_.given_J = std::max(run_.given_J, begin_J_ - tick.hand_J);
  run_.faults |= out.faults;
  if (run_.faults == 0) return false;
  if (run_.to_fault == FailureRun::kNever) run_.to_fault = static_cast<int>(now - from_tick_);
  const int since = static_cast<int>(now - from_tick_) - run_.to_fault;
  if (is_pushing_) run_.to_rest = since + 1;
  return since - run_.to_rest > kTicksAtRest;
}

void FailureWatch::add_torques(const record::TickOutput& out) {
  is_pushing_ = false;
  for (uint32_t k = 0; k < device_.joints.joints; ++k) {
    const double torque_Nm = wide(out.motor_N[k]), size_Nm = std::fabs(torque_Nm);
    const double most_Nm = wide(device_.limits.max_torque_Nm[k]);
    const double from_Nm = torque_Nm * before_Nm_[k] > 0 ? std::fabs(before_Nm_[k]) : 0;
    const double rise_Nm = most_Nm * std::min(1.0, kPeriod_s / wide(device_.torque_rise_s));
    run_.torque_share = std::max(run_.torque_share, size_Nm / most_Nm);
    run_.rise_share = std::max(run_.rise_share, size_Nm / std::min(most_Nm, from_Nm + rise_Nm));
    is_pushing_ |= !(size_Nm <= 0);  // NaN is no rest
    before_Nm_[k] = torque_Nm;
  }
}

void FailureWatch::add_words(const record::TickRecord& record) {
  for (const Field& field : fields()) {
    if (field.kind != Field::Kind::kFloat) continue;
    float word;
    std::memcpy(&word, reinterpret_cast<const char*>(&record) + field.offset, sizeof word);
    run_.not_finite += std::isfinite(word) ? 0u : 1u;
  }
}

std::vector<Touch> touches(double radius_m) {
  const auto hold = Rig::hold_s;
  const auto to = [&](double x, double above_m, double speed_mps) {
    return Rig::to({x, 0, radius_m + above_m}, speed_mps);
  };
  const Vec start_m{0.01, 0, radius_m + 0.002};
  const Lines rough = {{"friction_static", "0.6"}, {"friction_dynamic", "0.4"}};
  const std::string lead = hold(0.08), in = to(0.01, -0.003, 0.1);
  std::vector<Touch> all = {
      {"in the air", plate(0.04), start_m, {lead, to(-0.01, 0.004, 0.2), to(0.01, 0.002, 0.2)}, {}},
      {"pressing", plate(0.04), start_m, {lead, in, hold(0.2)}, {}},
      {"knocking",
       plate(0.04),
       start_m,
       {lead, to(0.01, -0.006, 0.6), to(0.01, 0.002, 0.6), to(0.01, -0.006, 0.6), hold(0.05)},
       {}},
      {"sliding", plate(0.04), start_m, {lead, in, to(-0.01, -0.003, 0.1)}, rough},
      {"in a groove",
       groove(0.7),
       {0.001, 0, radius_m + 0.002},
       {lead, to(0, -0.006, 0.1), to(0.004, -0.006, 0.05), hold(0.05)},
       {}},
      {"at two rates", plate(0.04), start_m, {lead, in, to(-0.01, -0.003, 0.1)}, rough}};
  all.back().settings.emplace_back("geometry_rate", "250 Hz");
  for (Touch& touch : all) {
    touch.script.push_back(hold(FailureRig::kTicksAfter * kPeriod_s));
    touch.settings.emplace_back("ramp_in", "0.03 s");
  }
  return all;
}

FailureRig::FailureRig(const std::string& machine, uint32_t touch)
    : device_(tools::read_device(machine, tools::read_device_text(machine))),
      rig_(touch + 1, machine),
      touch_(touches(rig_.radius_m)[touch]),
      session_(std::make_unique<Session>(rig_.bake(touch_.solid))) {
  const Scenario scenario = rig_.scenario(touch_.start_m, touch_.script, touch_.settings);
  const Environment environment;
  Simulation simulation(scenario, session_->tick(), environment);
  ticks_ = simulation.facts().ticks - kTicksAfter;
  if (!has_index()) return;
  for (RunTick now; simulation.next(now);)
    if (homed_tick_ == 0 && (now.record.output.state & record::kStateNotHomed) == 0)
      homed_tick_ = now.record.input.tick;
  first_tick_ = simulation.facts().ticks - kTicksAfter - ticks_;
}

FailureRig::~FailureRig() = default;

FailureRun FailureRig::run(const Failure& failure, uint32_t of_touch) {
  const uint32_t tick = first_tick_ + of_touch;
  Scenario scenario = rig_.scenario(touch_.start_m, touch_.script, touch_.settings);
  Event event;
  // What the hand passes on its way from homing to the touch is no surface yet.
  if (has_index()) {
    event.kind = Event::Kind::kDisable, event.time_s = homed_tick_ * kPeriod_s;
    scenario.events.push_back(event);
    event.kind = Event::Kind::kEnable, event.time_s = first_tick_ * kPeriod_s;
    scenario.events.push_back(event);
  }
  event.kind = Event::Kind::kFail, event.time_s = tick * kPeriod_s, event.failure = failure;
  scenario.events.push_back(event);
  session_->controller->reset();
  const Environment environment;
  Simulation simulation(scenario, session_->tick(), environment);
  FailureWatch watch(device_, tick);
  for (RunTick now; simulation.next(now) && now.record.input.tick < tick + kTicksAfter;)
    if (watch.add(now)) break;
  return watch.result();
}

}  // namespace firmtouch::host_sim
