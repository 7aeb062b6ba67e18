#pragma once
#include "firmtouch/controller/redundant_device.hpp"
#include "firmtouch/device/derating.hpp"

namespace firmtouch {

/// Any device of a linkage whose torque limits fall while its motors are hot, where the asset says
/// so (`continuous_torque_0` in a device file). It starts hot, and reset() makes it hot again; to
/// home anew does not. Weight and homing are within the limits, too.
template <class Base>
class DeratedDevice
    : public DeviceWithPart<Base, device::Derating, device::HeatState, device::before_derating> {
  using Parted = DeviceWithPart<Base, device::Derating, device::HeatState, device::before_derating>;

 public:
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear) {
    if (this->part_.is_open())
      device::heat(this->part_state_, this->part_, this->linkage_, this->before_Nm_, sample.dt_s,
                   most_Nm_);
    return Parted::read(values, sample, clear);
  }
  bool push(const params::Values& values, Push push, servo::GuardState& guard,
            record::TickOutput& output) {
    if (this->part_.is_open()) push.largest_Nm = most_Nm_;
    return Parted::push(values, push, guard, output);
  }

  const device::Derating& derating() const { return this->part_; }
  const device::HeatState& heat() const { return this->part_state_; }

 private:
  float most_Nm_[device::kMaxJoints] = {};
};

}  // namespace firmtouch
