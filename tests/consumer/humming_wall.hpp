#pragma once
#include <stdint.h>

#include "firmtouch/servo/local_model.hpp"

/// An effect of this project's own: a floor at `height_m` that shakes up and down by `amplitude_m`, 125 times a second at
/// 1 kHz. A finger on it feels it hum. The sphere's centre is held off by `radius_m`.
struct HummingWall {
  float height_m;
  float amplitude_m;
  float stiffness_N_per_m;
};

void add_hum(firmtouch::servo::LocalModel& model, const HummingWall& wall, float radius_m,
             uint32_t tick);
