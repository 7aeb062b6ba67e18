#pragma once
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// How a contact feels, from the forces while the motors are on. Bounded memory.
class ContactQuality {
 public:
  /// Forces above 5 % of `force_limit_N` have a direction whose turn is measured.
  ContactQuality(double rate_Hz, double force_limit_N);
  void add(Vec force_N, bool motors_are_on);

  /// Greatest root mean square over about 0.1 s of the force's part above 50 Hz. A hand feels
  /// vibration best at 100 to 300 Hz, and no motion of its own is that fast.
  double chatter_N() const { return chatter_N_; }
  /// Seconds during which that value was above `kChatterShare` of the force limit.
  double chatter_s() const { return chatter_s_; }
  /// Greatest angle between the forces of two successive ticks.
  double turn_rad() const { return turn_rad_; }

  static constexpr double kChatterShare = 0.025;

 private:
  struct Section {  // a second-order filter of one component
    double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  };
  double high_pass(Section& s, double x) const;

  double rate_Hz_, min_N_, limit_N_;
  double b0_, a1_, a2_;
  Section sections_[3];
  Vec last_N_;
  bool was_on_ = false;
  double mean_square_ = 0;
  double chatter_N_ = 0, chatter_s_ = 0, turn_rad_ = 0;
};

}  // namespace firmtouch::host_sim
