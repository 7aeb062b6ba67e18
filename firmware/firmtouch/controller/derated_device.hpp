#pragma once
#include "firmtouch/controller/redundant_device.hpp"
#include "firmtouch/device/derating.hpp"

namespace firmtouch {

/// Any device of a linkage whose torque limits fall while its motors are hot, where the asset says
/// so (`continuous_torque_0` in a device file). It starts hot, and reset() makes it hot again; to
/// home anew does not. Weight and homing are within the limits, too.
template <class Base>
class DeratedDevice : public Base {
 public:
  void close() {
    Base::close();
    derating_ = {};
  }
  template <class Trust>
  asset::Progress work(typename Base::State& state, uint32_t units) {
    const core::Bytes whole = this->section_;
    this->section_ = device::before_derating(whole);
    asset::Progress progress = Base::template work<Trust>(state, units);
    this->section_ = whole;
    if (progress.verdict.ok()) progress.verdict = device::open(whole, this->linkage_, derating_);
    if (!progress.verdict.ok()) close();
    return progress;
  }

  void reset() {
    Base::reset();
    state_ = {};
  }
  void continue_as(const DeratedDevice& other) {
    Base::continue_as(other);
    state_ = other.state_;
  }

  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear) {
    if (derating_.is_open())
      device::heat(state_, derating_, this->linkage_, this->before_Nm_, sample.dt_s, most_Nm_);
    return Base::read(values, sample, clear);
  }
  bool push(const params::Values& values, Push push, servo::GuardState& guard,
            record::TickOutput& output) {
    if (derating_.is_open()) push.largest_Nm = most_Nm_;
    return Base::push(values, push, guard, output);
  }

  const device::Derating& derating() const { return derating_; }
  const device::HeatState& heat() const { return state_; }

 private:
  device::Derating derating_;
  device::HeatState state_;
  float most_Nm_[device::kMaxJoints] = {};
};

}  // namespace firmtouch
