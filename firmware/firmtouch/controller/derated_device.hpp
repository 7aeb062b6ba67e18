#pragma once
#include "firmtouch/controller/redundant_device.hpp"
#include "firmtouch/device/derating.hpp"

namespace firmtouch {

/// Any device of a linkage whose torque limits fall while its motors are hot, where the asset says
/// so (`continuous_torque_0` in a device file). It starts hot, and reset() makes it hot again; to
/// home anew does not. Weight and homing are within the limits, too. The guard counts the heat by
/// its own means.
template <class Base>
class DeratedDevice : public DeviceWithPart<Base, device::Derating, device::HeatState> {
  using Parted = DeviceWithPart<Base, device::Derating, device::HeatState>;

 public:
  template <class Trust>
  asset::Progress work(typename Base::State& state, uint32_t units) {
    const asset::Progress progress = Parted::template work<Trust>(state, units);
    heat_guard();
    return progress;
  }
  void reset() {
    Parted::reset();
    heat_guard();
  }
  void continue_as(const DeratedDevice& other) {
    Parted::continue_as(other);
    heat_guard_ = other.heat_guard_;
  }

  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear) {
    if (this->part_.is_open())
      device::heat(this->part_state_, this->part_, this->linkage_, this->before_Nm_, sample.dt_s,
                   most_Nm_);
    return Parted::read(values, sample, clear);
  }
  bool push(const params::Values& values, Push push, servo::GuardState& guard,
            record::TickOutput& output) {
    if (!this->part_.is_open()) return Parted::push(values, push, guard, output);
    push.largest_Nm = most_Nm_;
    const bool passed = Parted::push(values, push, guard, output);
    if (servo::guard_heat(guard, heat_guard_, output.motor_N)) return passed;
    for (uint32_t k = 0; k < device::kMaxJoints; ++k) this->before_Nm_[k] = output.force_N[k] = 0;
    this->rendered_.share = 0;
    return false;
  }

  const device::Derating& derating() const { return this->part_; }
  const device::HeatState& heat() const { return this->part_state_; }

 private:
  void heat_guard() {
    if (this->part_.is_open())
      servo::set_heat(heat_guard_, this->part_.layout().continuous_Nm, this->part_.layout().time_s);
  }

  servo::HeatGuard heat_guard_;  // the guard's own
  float most_Nm_[device::kMaxJoints] = {};
};

}  // namespace firmtouch
