#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::query {

/// What the last certificate still says after the motion to `position_m`: distance is 1-Lipschitz.
struct Carried {
  float lower_m = 0;
  float safe_subtree_m = 0;
  int8_t sign = 0;     // the last side, where the path stayed within certified free distance
  float motion_m = 0;  // rounded up
};

/// Bounds: constant, about 45 instructions.
/// Result: nothing known (zeros) for a cold hint or a motion that is not finite.
Carried carry(const Hint& hint, math::Vec3 position_m);

}  // namespace firmtouch::query
