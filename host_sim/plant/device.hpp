#pragma once
#include <cstdint>
#include <vector>

#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// A Cartesian device: three equal axes of mass, friction, an encoder and a motor.
struct DeviceModel {
  double mass_kg = 0.075;  // moving mass seen at the tool, as of a small desktop device
  double viscous_N_s_per_m = 0.5;
  double coulomb_N = 0.02;            // an axis
  double encoder_quantum_m = 0;       // metres a count; 0: what the controller's parameters say
  double force_limit_N = 12;          // of a motor: more is cut off by the device itself
  uint32_t output_delay_samples = 0;  // ticks between a force computed and the force at the motor
};

/// One axis over one stretch of time with a force held constant over it: exact for mass and viscous
/// friction, so the stability limits of sampled walls come out at their closed-form values. Coulomb
/// friction holds an axis at rest until the force exceeds it, and stops it without turning it
/// round.
struct Axis {
  double position_m = 0;
  double velocity_mps = 0;
  void advance(const DeviceModel& model, double force_N, double time_s);
};

/// The device of a run: force in, encoder counts out.
class Device {
 public:
  Device(const DeviceModel& model, Vec start_m);

  /// Takes the motor forces computed in this tick; what reaches the motors now was computed
  /// `output_delay_samples` ago.
  void command(Vec motor_N);
  /// Moves under the motors' and the hand's force, both held for `time_s`.
  void advance(Vec hand_N, double time_s);

  Vec position_m() const { return {axis_[0].position_m, axis_[1].position_m, axis_[2].position_m}; }
  Vec velocity_mps() const {
    return {axis_[0].velocity_mps, axis_[1].velocity_mps, axis_[2].velocity_mps};
  }
  Vec motor_N() const { return motor_N_; }
  /// Whole quanta, rounded down as an incremental encoder's counter does.
  int32_t count(int axis) const;

 private:
  DeviceModel model_;
  Axis axis_[3];
  std::vector<Vec> queue_;  // forces on their way to the motors
  std::size_t next_ = 0;
  Vec motor_N_;
};

}  // namespace firmtouch::host_sim
