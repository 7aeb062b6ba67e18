#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::query {

/// What remains of the last certificate after the motion to `position_m`: distance is 1-Lipschitz.
struct Carried {
  float lower_m = 0;
  int8_t sign = 0;         // the last sign, where the path stayed within certified free distance
  float motion_m = 0;      // rounded up
  bool is_finite = false;  // the motion is; else nothing else is known
};

/// Bounds: constant, about 90 instructions.
/// Result: nothing known (zeros) for a cold hint or a motion that is not finite.
Carried carry(const HintBase& hint, math::Vec3 position_m);

}  // namespace firmtouch::query
