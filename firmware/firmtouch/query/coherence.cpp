#include "firmtouch/query/coherence.hpp"

#include "firmtouch/query/motion.hpp"

namespace firmtouch::query {

Carried carry(const HintBase& hint, math::Vec3 position_m) {
  const float moved_m = motion_m(hint, position_m);
  Carried carried;
  if (!(moved_m <= kMaxMotion_m)) return carried;
  carried.is_finite = true;
  carried.motion_m = moved_m;
  carried.lower_m = lower_left_of(hint.lower_m, moved_m);
  if (carried.lower_m > 0.0f) carried.sign = hint.sign;
  return carried;
}

}  // namespace firmtouch::query
