#pragma once
#include "firmtouch/controller/device_with_part.hpp"
#include "firmtouch/controller/homed_device.hpp"
#include "firmtouch/device/index_pulses.hpp"

namespace firmtouch {

/// HomedDevice whose joints have index pulses, where the asset says so (`index_0` in a device
/// file). They make homing exact. Once it is homed, a pulse at another count is an encoder fault in
/// its tick, and none where one is due in the third tick. It lasts until reset(), or until the
/// linkage is homed anew.
class IndexedDevice : public DeviceWithPart<HomedDevice, device::IndexPulses, device::IndexState> {
 public:
  static constexpr bool kComparesEncoders = true, kHasIndexPulses = true;

  template <class Trust>
  asset::Progress work(State& state, uint32_t units) {
    return work_by<Trust>(state, units, [this](core::Bytes section) {
      return homing_.is_open() ? part_.open(section, linkage_, homing_) : core::kPassed;
    });
  }

  bool encoders_agree(const device::Sample& sample, uint32_t flags);
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear);
  bool push(const params::Values& values, const Push& push, servo::GuardState& guard,
            record::TickOutput& output);

  const device::IndexPulses& index_pulses() const { return part_; }

 private:
  uint32_t pulses_ = 0;  // of this tick, while it is homed
  int32_t latched_[device::kMaxJoints] = {};
};

}  // namespace firmtouch
