#pragma once
#include "firmtouch/controller/homed_device.hpp"
#include "firmtouch/device/index_pulses.hpp"

namespace firmtouch {

/// HomedDevice whose joints have index pulses, where the asset says so (`index_0` in a device
/// file). They make homing exact. Once it is homed, a pulse at another count is an encoder fault in
/// its tick, and none where one is due in the third tick. It lasts until reset(), or until the
/// linkage is homed anew.
class IndexedDevice : public HomedDevice {
 public:
  static constexpr bool kComparesEncoders = true, kHasIndexPulses = true;

  void close() {
    HomedDevice::close();
    index_ = {};
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    const core::Bytes whole = section_;
    section_ = device::before_index_pulses(whole);
    asset::Progress progress = HomedDevice::work<Trust>(state, units);
    section_ = whole;
    if (progress.verdict.ok() && homing_.is_open())
      progress.verdict = device::open(whole, linkage_, homing_, index_);
    if (!progress.verdict.ok()) close();
    return progress;
  }

  void reset() {
    HomedDevice::reset();
    index_state_ = {};
  }
  void continue_as(const IndexedDevice& other) {
    HomedDevice::continue_as(other);
    index_state_ = other.index_state_;
  }

  bool encoders_agree(const device::Sample& sample, uint32_t flags);
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear);
  bool push(const params::Values& values, const Push& push, servo::GuardState& guard,
            record::TickOutput& output);

  const device::IndexPulses& index_pulses() const { return index_; }

 private:
  device::IndexPulses index_;
  device::IndexState index_state_;
  uint32_t pulses_ = 0;  // of this tick, while it is homed
  int32_t latched_[device::kMaxJoints] = {};
};

}  // namespace firmtouch
