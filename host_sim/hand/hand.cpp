#include "host_sim/hand/hand.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

constexpr double kPressShare =
    0.25;  // of a press's time for the way there, and again for the way back
constexpr double kLeanTime_s =
    0.4;  // a person leans on a surface, and lets go of it, in about this time

// 0 to 1 with no jump of velocity or acceleration at either end (minimum jerk).
double smooth(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

Vec between(Vec a, Vec b, double share) { return a + (b - a) * smooth(share); }

}  // namespace

Hand::Hand(const Scenario& scenario, const World& world, double tool_radius_m)
    : model_(scenario.hand), world_(&world), tool_radius_m_(tool_radius_m) {
  start_m_ = scenario.start_m;
  Vec at = start_m_;
  double now = 0, arc = 0;
  for (const Move& move : scenario.moves) {
    if (move.kind == Move::Kind::kFollow && !world.has_guide())
      throw Refused(scenario.file + ": the hand is to follow a guide, and " + scenario.asset +
                    " has none; bake a curve into it");
    Stretch stretch{move, now, now + move.time_s, at, arc};
    if (move.kind == Move::Kind::kFollow) {
      // To the guide in a straight line first, at the same speed, if the hand is not there.
      const Vec first = world.guide_at(arc);
      const double way_s = norm(first - at) / move.speed_mps;
      if (way_s > 1e-3) {
        Move approach;
        approach.kind = Move::Kind::kMove;
        approach.to_m = first;
        stretches_.push_back({approach, now, now + way_s, at, arc});
        stretch.begin_s += way_s;
        stretch.end_s += way_s;
      }
    } else if (move.kind == Move::Kind::kMove) {
      // Minimum jerk peaks at 15/8 of its mean speed; the speed stated is the mean.
      stretch.end_s = now + std::max(norm(move.to_m - at) / move.speed_mps, 1e-3);
    }
    if (move.kind == Move::Kind::kFollow) arc += move.speed_mps * move.time_s;
    now = stretch.end_s;
    stretches_.push_back(stretch);
    at = along(stretches_.back(), now);
  }
}

Vec Hand::on_guide(const Stretch& stretch, double time_s) const {
  const Vec guide =
      world_->guide_at(stretch.arc_m + stretch.move.speed_mps * (time_s - stretch.begin_s));
  if (!(stretch.move.press_m > 0) || !world_->has_surface()) return guide;
  const World::Surface surface = world_->nearest(guide);
  const Vec aim = surface.point_m + surface.normal * (tool_radius_m_ - stretch.move.press_m);
  const double length_s = stretch.end_s - stretch.begin_s;
  const double lean_s = std::min(kLeanTime_s, length_s / 3);
  const double lean = std::min(smooth((time_s - stretch.begin_s) / lean_s),
                               smooth((stretch.end_s - time_s) / lean_s));
  return guide + (aim - guide) * lean;
}

Vec Hand::along(const Stretch& stretch, double time_s) const {
  const double length_s = stretch.end_s - stretch.begin_s;
  const double share = length_s > 0 ? (time_s - stretch.begin_s) / length_s : 1;
  switch (stretch.move.kind) {
    case Move::Kind::kHold:
      return stretch.from_m;
    case Move::Kind::kMove:
      return between(stretch.from_m, stretch.move.to_m, share);
    case Move::Kind::kPress:
      return share < 0.5 ? between(stretch.from_m, stretch.move.to_m, share / kPressShare)
                         : between(stretch.move.to_m, stretch.from_m,
                                   (share - 1 + kPressShare) / kPressShare);
    case Move::Kind::kFollow:
      return on_guide(stretch, time_s);
  }
  return stretch.from_m;
}

Vec Hand::target_m(double time_s) const {
  for (const Stretch& stretch : stretches_)
    if (time_s < stretch.end_s) return along(stretch, time_s);
  return stretches_.empty() ? start_m_ : along(stretches_.back(), stretches_.back().end_s);
}

Vec Hand::force_N(Vec target_m, Vec target_mps, Vec position_m, Vec velocity_mps) const {
  return (target_m - position_m) * model_.stiffness_N_per_m +
         (target_mps - velocity_mps) * model_.damping_N_s_per_m;
}

}  // namespace firmtouch::host_sim
