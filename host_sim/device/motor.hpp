#pragma once
#include "device/device_file.hpp"
#include "host_sim/device/winding.hpp"

namespace firmtouch::host_sim {

/// What an amplifier and a motor make of a torque: a lag of the first order, what warm magnets
/// leave of it, then ripple and cogging, both sines of the rotor's angle.
class Motor {
 public:
  Motor() = default;
  explicit Motor(const tools::JointFriction& drive, const MotorRating& rating = {})
      : drive_(drive), winding_(rating) {}
  /// The mean over `time_s`, exact of the lag, with the rotor at `rotor_rad`.
  double torque_Nm(double wanted_Nm, double rotor_rad, double time_s);
  const Winding& winding() const { return winding_; }

 private:
  tools::JointFriction drive_;
  Winding winding_;
  double made_Nm_ = 0;  // by the amplifier
};

}  // namespace firmtouch::host_sim
