#pragma once
#include "firmtouch/controller/indexed_device.hpp"
#include "firmtouch/device/second_encoders.hpp"

namespace firmtouch {

/// AnyDevice, HomedDevice or IndexedDevice that compares each joint's encoder with a second one,
/// where the asset says so (`second_0` in a device file). A tick in which two have turned
/// differently is a rejected sample: the third in a row is an encoder fault. They are compared from
/// the first sample on, or from the end of homing. What differs goes on being rejected until
/// reset(), or until a linkage that is homed is homed anew.
template <class Base>
class RedundantDevice : public DeviceWithPart<Base, device::SecondEncoders, device::SecondState> {
 public:
  static constexpr bool kComparesEncoders = true, kHasSecondEncoders = true;

  /// `flags`: of the tick's input. Before read(). Result: whether the sample may be trusted.
  bool encoders_agree(const device::Sample& sample, uint32_t flags) {
    if (!this->part_.is_open()) {
      if constexpr (Base::kComparesEncoders) return Base::encoders_agree(sample, flags);
      return true;
    }
    const uint32_t counts = flags >> record::kFlagSecondCountsShift;
    if (is_to_compare())
      return device::agree(this->part_state_, this->part_, this->linkage_, sample, counts);
    device::align(this->part_state_, sample, counts);
    return true;
  }

  const device::SecondEncoders& second_encoders() const { return this->part_; }

 private:
  bool is_to_compare() const {
    if constexpr (Base::kHomes)
      if (!Base::is_homed()) return false;
    return this->part_state_.is_aligned;
  }
};

}  // namespace firmtouch
