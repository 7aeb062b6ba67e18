#pragma once
#include <cstdint>
#include <vector>

#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Parameters of a Cartesian device: three equal axes, each with mass, friction, encoder and motor.
struct DeviceModel {
  double mass_kg = 0.075;  // moving mass at the tool; typical of a small desktop device
  double viscous_N_s_per_m = 0.5;
  double coulomb_N = 0.02;            // per axis
  double encoder_quantum_m = 0;       // metres per count; 0: from the controller's parameters
  double force_limit_N = 12;          // per motor; the device saturates there
  uint32_t output_delay_samples = 0;  // ticks from the computed force to the motor's
  double output_delay_part = 0;       // of a sample more, from 0 to 1: in a run
};

/// One axis under a force that is constant during `time_s`. Exact for mass and viscous friction, so
/// the stability limits of sampled walls equal their closed forms. Coulomb friction holds an axis
/// at rest until the force exceeds it, and can stop it but not reverse it.
struct Axis {
  double position_m = 0;
  double velocity_mps = 0;
  void advance(const DeviceModel& model, double force_N, double time_s);
};

/// The simulated device: motor forces in, encoder counts out.
class Device {
 public:
  Device(const DeviceModel& model, Vec start_m);

  /// Queues this tick's motor forces; the motors now apply those of `output_delay_samples` ago.
  void command(Vec motor_N);
  /// Moves under the motors' and the hand's forces, both constant during `time_s`.
  void advance(Vec hand_N, double time_s);

  Vec position_m() const { return {axis_[0].position_m, axis_[1].position_m, axis_[2].position_m}; }
  Vec velocity_mps() const {
    return {axis_[0].velocity_mps, axis_[1].velocity_mps, axis_[2].velocity_mps};
  }
  Vec motor_N() const { return motor_N_; }
  /// What the motors can make of these forces.
  Vec limited(Vec motor_N) const;
  /// Encoder count: position in quanta, rounded down as an incremental encoder does.
  int32_t count(int axis) const;

 private:
  DeviceModel model_;
  Axis axis_[3];
  std::vector<Vec> queue_;  // delayed forces
  std::size_t next_ = 0;
  Vec motor_N_;
};

}  // namespace firmtouch::host_sim
