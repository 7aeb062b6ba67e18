#pragma once
#include "firmtouch/device/layout.hpp"

namespace firmtouch::device_test {

/// A five-bar as an asset stores it, with joints from `low_rad` to `high_rad`.
inline device::LinkageLayout stored_bar(float counts_per_rad, float low_rad = .5f,
                                        float high_rad = 2) {
  device::LinkageLayout to = {};
  to.kind = device::kFiveBar;
  to.joints = 2;
  for (uint32_t k = 0; k < 2; ++k) {
    to.length_m[k] = .07f;
    to.length_m[2 + k] = .09f;
    to.joint[k] = {counts_per_rad, 0, low_rad, high_rad};
    to.max_torque_Nm[k] = .3f;
  }
  to.torque_rise_s = .002f;
  to.max_speed_rad_per_s = 100;
  to.full_from = .1f;
  to.gone_at = .05f;
  return to;
}

}  // namespace firmtouch::device_test
