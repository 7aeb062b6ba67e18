#pragma once
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// Mass of a hand between its grip on the device and its arm: the arm's spring and damper pull it
/// to the target. With the grip these are the five parameters of Speich, Shao & Goldfarb 2005
/// (Modeling the human hand as it interacts with a telemanipulation system, Mechatronics 15).
class Palm {
 public:
  /// Pre: model.mass_kg > 0.
  Palm(const HandModel& model, Vec start_m)
      : mass_kg_(model.mass_kg),
        stiffness_N_per_m_(model.arm_stiffness_N_per_m),
        damping_N_s_per_m_(model.arm_damping_N_s_per_m),
        position_m_(start_m) {}

  /// `grip_N`: on the device, constant during the step; `target_m`: at its end, that moved evenly.
  /// By the implicit midpoint rule, which gives no energy at any step.
  void advance(Vec target_m, Vec target_mps, Vec grip_N, double time_s) {
    const double half_s = 0.5 * time_s;
    const Vec pull_N = (target_m - target_mps * half_s - position_m_) * stiffness_N_per_m_ +
                       target_mps * damping_N_s_per_m_ - grip_N;
    const Vec mean_mps =
        (velocity_mps_ * (mass_kg_ / half_s) + pull_N) *
        (1 / (mass_kg_ / half_s + stiffness_N_per_m_ * half_s + damping_N_s_per_m_));
    position_m_ = position_m_ + mean_mps * time_s;
    velocity_mps_ = mean_mps * 2 - velocity_mps_;
  }
  Vec position_m() const { return position_m_; }
  Vec velocity_mps() const { return velocity_mps_; }

 private:
  double mass_kg_, stiffness_N_per_m_, damping_N_s_per_m_;
  Vec position_m_, velocity_mps_;
};

/// Force on a grip that moves by a sine, over its amplitude, the target at rest, in closed form.
double impedance_N_per_m(const HandModel& model, double frequency_Hz);

}  // namespace firmtouch::host_sim
