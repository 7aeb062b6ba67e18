#include "firmtouch/controller/indexed_device.hpp"

namespace firmtouch {

bool IndexedDevice::encoders_agree(const device::Sample& sample, uint32_t flags) {
  if (!part_.is_open()) return true;
  const uint32_t packed = flags >> record::kFlagSecondCountsShift;
  if (is_homed()) {
    if (!part_state_.is_started) start(part_state_, part_, linkage_, state_.pulse, sample);
    return follow(part_state_, part_, linkage_, sample, packed);
  }
  pulses_ = pulses_of(part_state_, sample, packed, latched_);
  part_state_ = {};
  for (uint32_t k = 0; k < device::kMaxJoints; ++k) part_state_.counts[k] = sample.counts[k];
  return true;
}

device::Reading IndexedDevice::read(const params::Values& values, const device::Sample& sample,
                                    bool clear) {
  device::Reading reading = HomedDevice::read(values, sample, clear);
  if (!sample.trusted) {
    pulses_ = 0;
    excuse(part_state_);
  }
  if (part_state_.is_off) reading.faults |= device::kEncoderFault;
  return reading;
}

bool IndexedDevice::push(const params::Values& values, const Push& push, servo::GuardState& guard,
                         record::TickOutput& output) {
  if (is_homed() || !part_.is_open()) return HomedDevice::push(values, push, guard, output);
  device::HomingSample sample = {sample_, pulses_, {}, {}};
  for (uint32_t k = 0; k < device::kMaxJoints; ++k) sample.latched[k] = latched_[k];
  return push_home(values, push, guard, output, settings_of(homing_, part_), sample);
}

}  // namespace firmtouch
