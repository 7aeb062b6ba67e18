#pragma once
#include "device/device_file.hpp"

namespace firmtouch::host_sim {

/// A figure of the simulation beside its closed form; 0: the device file has no such thing.
struct Predicted {
  double measured = 0, closed_form = 0;
  double error() const;
};

/// The cables of a linkage at the middle of its ranges, without gravity and friction.
struct TransmissionCheck {
  /// First resonance: the least eigenvalue of cables x (1 / rotors + inverse inertia).
  Predicted resonance_Hz;
  /// Limit cycle of the first joint with backlash, whose motor holds the joint's own angle with
  /// half of the cable's stiffness K: by the describing function of the gap sqrt(K / 2 x inverse
  /// inertia), and the twist at which the cable seems as stiff as the motor. The joint, which its
  /// inertia makes a sine, moves by as much.
  Predicted cycle_Hz, cycle_rad;
};

/// The goals.
constexpr double kMaxResonanceError = 0.01, kMaxCycleError = 0.05;

/// With cables that twist by 20 mrad at the largest torque and 0.1 deg of backlash, where the
/// device file has no cable. Result: false where it has one, or a joint lacks its rotor.
bool assume_cables(tools::LinkageDevice& device);

TransmissionCheck check_transmission(const tools::LinkageDevice& device);
bool is_good(const TransmissionCheck& check);

}  // namespace firmtouch::host_sim
