#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::query {

/// What the last certificate still says after the motion to `position_m`: distance is 1-Lipschitz.
struct Carried {
  float lower_m = 0;
  int8_t sign = 0;  // the last side, where the path stayed within certified free distance
};

/// Bounds: constant, about 25 instructions. Result: nothing known (0, 0) for a cold hint or a motion that is not finite.
Carried carry(const Hint& hint, math::Vec3 position_m);

}  // namespace firmtouch::query
