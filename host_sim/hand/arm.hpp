#pragma once
#include <cmath>

#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// Low-pass filter between the script and the hand's spring: two equal first-order lags. It rounds
/// the script's corners as an arm does.
class Arm {
 public:
  /// Steps of `time_s`.
  Arm(Vec start_m, double time_s) : first_m_(start_m), second_m_(start_m) { set_step(time_s); }
  void set_step(double time_s) {
    per_s_ = 1 / time_s;
    share_ = -std::expm1(-time_s / kLag_s);
  }
  void advance(Vec script_m) {
    first_m_ = first_m_ + (script_m - first_m_) * share_;
    const Vec before = second_m_;
    second_m_ = second_m_ + (first_m_ - second_m_) * share_;
    velocity_mps_ = (second_m_ - before) * per_s_;
  }
  Vec position_m() const { return second_m_; }
  Vec velocity_mps() const { return velocity_mps_; }

  static constexpr double kLag_s = 0.012;  // of each

 private:
  Vec first_m_, second_m_, velocity_mps_;
  double per_s_ = 0, share_ = 0;
};

}  // namespace firmtouch::host_sim
