#include "host_sim/hand/hand.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/hand/arm.hpp"

namespace firmtouch::host_sim {
namespace {

// Share of a press's time for the approach, and again for the return.
constexpr double kPressShare = 0.25;
// Share of a startle's time for the way there. It and the times are assumed.
constexpr double kStartleShare = 0.2;
constexpr double kClose_s = 0.2;  // of a grip, assumed
constexpr double kPi = 3.14159265358979323846;
// Time in which a person begins or ends to press on a surface, roughly.
constexpr double kLeanTime_s = 0.4;

// Minimum-jerk profile from 0 to 1: velocity and acceleration are 0 at both ends.
double smooth(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

Vec between(Vec a, Vec b, double share) { return a + (b - a) * smooth(share); }

}  // namespace

Hand::Hand(const Scenario& scenario, const Environment& environment, double tool_radius_m)
    : model_(scenario.hand),
      recorded_(scenario.recorded),
      environment_(&environment),
      tool_radius_m_(tool_radius_m) {
  start_m_ = recorded_.empty() ? scenario.start_m : recorded_.front().at_m;
  Vec at = start_m_;
  for (const Move& move : scenario.moves) lets_go_ |= move.kind == Move::Kind::kLetGo;
  double now = 0, arc = 0;
  for (const Move& move : scenario.moves) {
    if (move.kind == Move::Kind::kFollow && !environment.has_guide())
      throw Refused(scenario.file + ": the script follows a guide, but " + scenario.asset +
                    " has none; bake a curve into it");
    Phase phase{move, now, now + move.time_s, at, arc};
    if (move.kind == Move::Kind::kFollow) {
      // Approaches the guide in a straight line first, at the same speed.
      const Vec first = environment.guide_at(arc);
      const double approach_s = norm(first - at) / move.speed_mps;
      if (approach_s > 1e-3) {
        Move approach;
        approach.kind = Move::Kind::kMove;
        approach.to_m = first;
        phases_.push_back({approach, now, now + approach_s, at, arc});
        phase.begin_s += approach_s;
        phase.end_s += approach_s;
      }
    } else if (move.kind == Move::Kind::kMove) {
      // The stated speed is the mean; minimum jerk peaks at 15/8 of it.
      phase.end_s = now + std::max(norm(move.to_m - at) / move.speed_mps, 1e-3);
    }
    if (move.kind == Move::Kind::kFollow) arc += move.speed_mps * move.time_s;
    now = phase.end_s;
    phases_.push_back(phase);
    at = along(phases_.back(), now);
  }
}

Vec Hand::on_guide(const Phase& phase, double time_s) const {
  const Vec guide =
      environment_->guide_at(phase.arc_m + phase.move.speed_mps * (time_s - phase.begin_s));
  if (!(phase.move.press_m > 0) || !environment_->has_surface()) return guide;
  const Environment::Surface surface = environment_->nearest(guide);
  const Vec aim = surface.point_m + surface.normal * (tool_radius_m_ - phase.move.press_m);
  const double length_s = phase.end_s - phase.begin_s;
  const double lean_s = std::min(kLeanTime_s, length_s / 3);
  const double lean =
      std::min(smooth((time_s - phase.begin_s) / lean_s), smooth((phase.end_s - time_s) / lean_s));
  return guide + (aim - guide) * lean;
}

Vec Hand::along(const Phase& phase, double time_s) const {
  const double length_s = phase.end_s - phase.begin_s;
  const double share = length_s > 0 ? (time_s - phase.begin_s) / length_s : 1;
  switch (phase.move.kind) {
    case Move::Kind::kHold:
    case Move::Kind::kLetGo:
      return phase.from_m;
    case Move::Kind::kStartle:
      return share < kStartleShare ? between(phase.from_m, phase.move.to_m, share / kStartleShare)
                                   : between(phase.move.to_m, phase.from_m,
                                             (share - kStartleShare) / (1 - kStartleShare));
    case Move::Kind::kMove:
      return between(phase.from_m, phase.move.to_m, share);
    case Move::Kind::kPress:
      return share < 0.5
                 ? between(phase.from_m, phase.move.to_m, share / kPressShare)
                 : between(phase.move.to_m, phase.from_m, (share - 1 + kPressShare) / kPressShare);
    case Move::Kind::kFollow:
      return on_guide(phase, time_s);
  }
  return phase.from_m;
}

// A record lasts until the next one would follow.
double Hand::end_s() const {
  const size_t n = recorded_.size();
  if (n > 1) return 2 * recorded_[n - 1].time_s - recorded_[n - 2].time_s;
  return phases_.empty() ? 0 : phases_.back().end_s;
}

// A straight line from sample to sample.
Vec Hand::recorded_m(double time_s) const {
  double give_m_per_N = model_.stiffness_N_per_m > 0 ? 1 / model_.stiffness_N_per_m : 0;
  if (model_.mass_kg > 0 && model_.arm_stiffness_N_per_m > 0)
    give_m_per_N += 1 / model_.arm_stiffness_N_per_m;
  const auto target_m = [&](const HandSample& s) { return s.at_m - s.force_N * give_m_per_N; };
  const auto next =
      std::upper_bound(recorded_.begin(), recorded_.end(), time_s,
                       [](double time, const HandSample& s) { return time < s.time_s; });
  if (next == recorded_.begin()) return target_m(recorded_.front());
  if (next == recorded_.end()) return target_m(recorded_.back());
  const HandSample& before = *(next - 1);
  const double share = (time_s - before.time_s) / (next->time_s - before.time_s);
  return target_m(before) * (1 - share) + target_m(*next) * share;
}

Vec Hand::target_m(double time_s) const {
  if (!recorded_.empty()) return recorded_m(time_s + 2 * Arm::kLag_s);
  for (const Phase& phase : phases_)
    if (time_s < phase.end_s) return along(phase, time_s);
  return phases_.empty() ? start_m_ : along(phases_.back(), phases_.back().end_s);
}

double Hand::grip(double time_s) const {
  double share = 1;
  for (const Phase& phase : phases_) {
    if (phase.move.kind != Move::Kind::kLetGo || time_s < phase.begin_s) continue;
    share = time_s < phase.end_s ? 0 : smooth((time_s - phase.end_s) / kClose_s);
  }
  return share;
}

Vec Hand::force_N(double time_s, Vec target_m, Vec target_mps, Vec position_m,
                  Vec velocity_mps) const {
  if (model_.tremor_m > 0) {
    const double turn = 2 * kPi * model_.tremor_Hz, third = 2 * kPi / 3;
    const double phase[3] = {turn * time_s, turn * time_s + third, turn * time_s - third};
    target_m = target_m +
               Vec{std::sin(phase[0]), std::sin(phase[1]), std::sin(phase[2])} * model_.tremor_m;
    target_mps = target_mps + Vec{std::cos(phase[0]), std::cos(phase[1]), std::cos(phase[2])} *
                                  (model_.tremor_m * turn);
  }
  const Vec stretch_m = target_m - position_m;
  double stiffness_N_per_m = model_.stiffness_N_per_m;
  if (model_.stiffening_per_m > 0)
    stiffness_N_per_m *= 1 + model_.stiffening_per_m * norm(stretch_m);
  const Vec force_N =
      stretch_m * stiffness_N_per_m + (target_mps - velocity_mps) * model_.damping_N_s_per_m;
  return lets_go_ ? force_N * grip(time_s) : force_N;
}

}  // namespace firmtouch::host_sim
