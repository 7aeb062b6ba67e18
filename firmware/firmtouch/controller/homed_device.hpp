#pragma once
#include "firmtouch/controller/any_device.hpp"
#include "firmtouch/device/stored_homing.hpp"

namespace firmtouch {

/// AnyDevice that homes its linkage where the asset says how (`home` in a device file). Until then
/// nothing is rendered, and while the operator enables, the motors home the joints. All of it is in
/// the tick, so that a log replays it. `state` of the record says what it does, and what failed.
/// Disabling stops it; enabling begins anew. After a fault: clear_faults, then enable.
/// A linkage that lost an encoder is homed anew before it renders again.
class HomedDevice : public AnyDevice {
 public:
  static constexpr bool kHomes = true;

  void close() {
    AnyDevice::close();
    homing_ = {};
  }
  template <class Trust>
  asset::Progress work(State&, uint32_t) {
    const core::Verdict verdict = device::open(section_, linkage_, homing_);
    if (verdict.ok()) take_ceilings();
    return {true, verdict};
  }

  void reset();
  void continue_as(const HomedDevice& other);
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear);
  bool push(const params::Values& values, const Push& push, servo::GuardState& guard,
            record::TickOutput& output);

  const device::StoredHoming& homing() const { return homing_; }
  bool is_homed() const { return !homing_.is_open() || state_.is_done; }
  bool has_failed() const { return state_.fault != device::HomingFault::kNone; }

 protected:
  /// push() where it is not homed. `sample`: of this tick.
  bool push_home(const params::Values& values, const Push& push, servo::GuardState& guard,
                 record::TickOutput& output, const device::HomingSettings& settings,
                 const device::HomingSample& sample);

  device::StoredHoming homing_;
  device::HomingState state_;
  device::Sample sample_ = {};  // of this tick

 private:
  bool is_lost_ = false;  // an encoder was lost: counts may be missing
};

}  // namespace firmtouch
