#pragma once
#include <stdint.h>

#include "firmtouch/servo/local_model.hpp"

/// An effect of this project: a floor at `height_m` that moves up and down by `amplitude_m`, 125
/// times a second at 1 kHz, so that it hums under a finger. The sphere's centre stays `radius_m`
/// above it.
struct HummingWall {
  float height_m;
  float amplitude_m;
  float stiffness_N_per_m;
};

void add_hum(firmtouch::servo::LocalModel& model, const HummingWall& wall, float radius_m,
             uint32_t tick);
