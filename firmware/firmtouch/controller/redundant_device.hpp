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
class RedundantDevice : public Base {
 public:
  static constexpr bool kComparesEncoders = true, kHasSecondEncoders = true;

  void close() {
    Base::close();
    second_ = {};
  }
  template <class Trust>
  asset::Progress work(typename Base::State& state, uint32_t units) {
    const core::Bytes whole = this->section_;
    this->section_ = device::before_second_encoders(whole);
    asset::Progress progress = Base::template work<Trust>(state, units);
    this->section_ = whole;
    if (progress.verdict.ok()) progress.verdict = device::open(whole, this->linkage_, second_);
    if (!progress.verdict.ok()) close();
    return progress;
  }

  void reset() {
    Base::reset();
    state_ = {};
  }
  void continue_as(const RedundantDevice& other) {
    Base::continue_as(other);
    state_ = other.state_;
  }

  /// `flags`: of the tick's input. Before read(). Result: whether the sample may be trusted.
  bool encoders_agree(const device::Sample& sample, uint32_t flags) {
    if (!second_.is_open()) {
      if constexpr (Base::kComparesEncoders) return Base::encoders_agree(sample, flags);
      return true;
    }
    const uint32_t counts = flags >> record::kFlagSecondCountsShift;
    if (is_to_compare()) return device::agree(state_, second_, this->linkage_, sample, counts);
    device::align(state_, sample, counts);
    return true;
  }

  const device::SecondEncoders& second_encoders() const { return second_; }

 private:
  bool is_to_compare() const {
    if constexpr (Base::kHomes)
      if (!Base::is_homed()) return false;
    return state_.is_aligned;
  }

  device::SecondEncoders second_;
  device::SecondState state_;
};

}  // namespace firmtouch
