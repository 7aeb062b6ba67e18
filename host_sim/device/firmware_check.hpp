#pragma once
#include <cstdint>

#include "device/device_file.hpp"

namespace firmtouch::host_sim {

/// The firmware's linkage against the simulated one, at random poses with the whole force.
struct FirmwareCheck {
  uint32_t poses = 0;
  double inverse_m = 0;  // largest error of the tip at the angles that put it there in double
  double jacobian = 0;   // off central differences in double, over its norm
  double force = 0;      // of the force at the tip, relative, from counts to torques
  // Largest reciprocal condition at which it misses its goal; 0: nowhere.
  double force_condition = 0;
  // Of the weight's torques that the firmware carries, over the largest; 0 without weight.
  double weight = 0;
  double heaviest_Nm = 0;
};

/// The goals: 1e-6 m, 1e-5, half a percent, one percent.
constexpr double kMaxInverse_m = 1e-6, kMaxJacobianError = 1e-5;
constexpr double kMaxForceError = 0.005, kMaxWeightError = 0.01;

FirmwareCheck check_firmware(const tools::LinkageDevice& device, uint32_t poses);

bool is_good(const FirmwareCheck& check);

}  // namespace firmtouch::host_sim
