#pragma once
#include "device/device_file.hpp"

namespace firmtouch::host_sim {

/// What an amplifier and a motor make of a torque: a lag of the first order, then ripple and
/// cogging, both sines of the rotor's angle.
class Motor {
 public:
  Motor() = default;
  explicit Motor(const tools::JointFriction& drive) : drive_(drive) {}
  /// The mean over `time_s`, exact of the lag, with the rotor at `rotor_rad`.
  double torque_Nm(double wanted_Nm, double rotor_rad, double time_s);

 private:
  tools::JointFriction drive_;
  double made_Nm_ = 0;  // by the amplifier
};

}  // namespace firmtouch::host_sim
