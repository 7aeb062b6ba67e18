#include "firmtouch/controller/cartesian_device.hpp"

namespace firmtouch {
namespace {

using params::Values;

device::Settings device_settings(const Values& v) {
  return {{v[params::kCountsPerMetreX], v[params::kCountsPerMetreY], v[params::kCountsPerMetreZ]},
          {v[params::kOriginX], v[params::kOriginY], v[params::kOriginZ]},
          {v[params::kWorkspaceHalfX], v[params::kWorkspaceHalfY], v[params::kWorkspaceHalfZ]},
          v[params::kMaxSpeed],
          velocity_settings(v)};
}

}  // namespace

device::VelocitySettings velocity_settings(const Values& v) {
  return {static_cast<device::Estimator>(static_cast<uint8_t>(v[params::kVelocityEstimator])),
          v[params::kVelocityFilter]};
}

device::Reading CartesianDevice::read(const Values& values, const device::Sample& sample,
                                      bool clear) {
  if (clear) device::clear(state_);
  return device::read(state_, device_settings(values), sample);
}

bool CartesianDevice::push(const Values&, const Push& push, servo::GuardState& guard,
                           record::TickOutput& output) {
  output.motor_N[0] = push.force_N.x;
  output.motor_N[1] = push.force_N.y;
  output.motor_N[2] = push.force_N.z;
  const bool passed = servo::guard(guard, push.may_push, push.cut, output.motor_N);
  for (uint32_t k = 0; k < record::kAxes; ++k) output.force_N[k] = output.motor_N[k];
  return passed;
}

}  // namespace firmtouch
