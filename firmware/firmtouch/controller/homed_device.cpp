#include "firmtouch/controller/homed_device.hpp"

namespace firmtouch {
namespace {

using params::Values;

uint32_t state_bits(const device::HomingState& state, bool is_driven) {
  if (state.fault == device::HomingFault::kNone)
    return record::kStateNotHomed | (is_driven ? record::kStateHoming : 0u);
  const uint32_t failed = static_cast<uint32_t>(state.fault) | state.joint << 4 | state.other << 6;
  return record::kStateNotHomed | failed << record::kStateHomingFaultShift;
}

constexpr float kNoTorques_Nm[device::kMaxJoints] = {};

bool is_zero(const float (&torque_Nm)[record::kAxes]) {
  for (const float each : torque_Nm)
    if (each < 0.0f || each > 0.0f) return false;
  return true;
}

}  // namespace

void HomedDevice::reset() {
  AnyDevice::reset();
  state_ = {};
  is_lost_ = false;
}

void HomedDevice::continue_as(const HomedDevice& other) {
  AnyDevice::continue_as(other);
  state_ = other.state_;
  is_lost_ = other.is_lost_;
}

device::Reading HomedDevice::read(const Values& values, const device::Sample& sample, bool clear) {
  sample_ = sample;
  if (is_homed()) {
    for (uint32_t k = 0; k < device::kMaxJoints && homing_.is_open(); ++k)
      sample_.counts[k] = static_cast<int32_t>(static_cast<uint32_t>(sample.counts[k]) +
                                               static_cast<uint32_t>(state_.offset[k]));
    const device::Reading reading = AnyDevice::read(values, sample_, clear);
    is_lost_ |= reading.started && (reading.faults & device::kEncoderFault) != 0;
    return reading;
  }
  if (clear) state_ = {};
  device::Reading reading = {};
  reading.accepted = sample.trusted;
  return reading;
}

bool HomedDevice::push(const Values& values, const Push& push, servo::GuardState& guard,
                       record::TickOutput& output) {
  if (is_homed()) {
    const bool passed = AnyDevice::push(values, push, guard, output);
    const bool is_quiet = !push.is_on && is_zero(output.motor_N);
    if (homing_.is_open() && is_lost_ && is_quiet) reset();
    return passed;
  }
  return push_home(values, push, guard, output, homing_.settings(), {sample_, 0, {}, {}});
}

bool HomedDevice::push_home(const Values& values, const Push& push, servo::GuardState& guard,
                            record::TickOutput& output, const device::HomingSettings& settings,
                            const device::HomingSample& sample) {
  device::JointTorques wanted = {};
  if (push.may_push) {
    const device::HomingTorques torques =
        home(state_, settings, linkage_.joints(velocity_settings(values)), sample);
    wanted.share = 1;
    for (uint32_t k = 0; k < device::kMaxJoints; ++k) wanted.torque_Nm[k] = torques.torque_Nm[k];
  } else if (!has_failed()) {
    state_ = {};
  }
  output.state |= state_bits(state_, push.may_push);
  return drive(values, push, wanted, kNoTorques_Nm, guard, output);
}

}  // namespace firmtouch
