#pragma once
#include "firmtouch/record/tick.hpp"
#include "host_sim/plant/environment.hpp"

namespace firmtouch::host_sim {

/// The material that the tool touches, from 1; 0: none.
uint32_t touched_material(const record::TickOutput& out, const Environment* environment);

/// The part of a tick's force that is contact. Without contact there is none: the force is that of
/// a guide, or falls by the slew limit after one that has let go. In contact on a guide only a
/// proxy separates the two: by its spring, without the damper and without the limits of force and
/// torque. A spring and a guide that pull against each other leave a force of any direction, which
/// says nothing of either.
Vec contact_force_N(const record::TickOutput& out, double stiffness_N_per_m);

/// Turns of contact from tick to tick that no texture states. Along a unit normal n a texture of
/// slope g turns contact to n + g (scene/texture.hpp).
class ContactTurn {
 public:
  /// Without an environment there is no texture; else it outlives this.
  explicit ContactTurn(const Environment* environment = nullptr) : environment_(environment) {}
  /// Result: the angle to the contact of the tick before; or without the texture of the material
  /// that is touched, or of the one before it, where that is smaller. Behind a border a texture has
  /// a share, from 0 to 1 (scene/material_touch.hpp).
  double add_rad(const record::TickOutput& out, Vec contact_N);

 private:
  const Environment* environment_;
  uint32_t material_ = 0, before_ = 0;
  Vec last_N_, last_m_;
};

/// How a contact feels, from the forces while the motors are on. Bounded memory.
class ContactQuality {
 public:
  /// Forces above 5 % of `force_limit_N` have a direction whose turn is measured.
  ContactQuality(double rate_Hz, double force_limit_N);
  void add(Vec force_N, Vec contact_N, double turn_rad, bool motors_are_on);

  /// Greatest root mean square over about 0.1 s of the force's part above 50 Hz. A hand feels
  /// vibration best at 100 to 300 Hz, and no motion of its own is that fast.
  double chatter_N() const { return chatter_N_; }
  /// Seconds during which that value was above `kChatterShare` of the force limit.
  double chatter_s() const { return chatter_s_; }
  /// Greatest `turn_rad` between two successive ticks.
  double turn_rad() const { return turn_rad_; }
  /// Greatest change in a tick of what is not contact, and by no more than the force changes: of a
  /// guide that takes hold, or whose nearest stretch is another.
  double guide_step_N() const { return guide_step_N_; }

  static constexpr double kChatterShare = 0.025;

 private:
  struct Section {  // a second-order filter of one component
    double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  };
  double high_pass(Section& s, double x) const;

  double rate_Hz_, min_N_, limit_N_;
  double b0_, a1_, a2_;
  Section sections_[3];
  Vec last_N_, last_contact_N_;
  bool was_on_ = false;
  double mean_square_ = 0;
  double chatter_N_ = 0, chatter_s_ = 0, turn_rad_ = 0, guide_step_N_ = 0;
};

}  // namespace firmtouch::host_sim
