#include "firmtouch/query/coherence.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::query {

Carried carry(const Hint& hint, math::Vec3 position_m) {
  const math::Vec3 step = position_m - hint.position_m;
  // The motion rounded up (five operations of relative error 2^-24 each), what is left of the radius rounded down.
  const float motion_m = math::length(step) * (1.0f + 8.0f * 0x1p-24f);
  const float left_m = (hint.lower_m - motion_m) * (1.0f - 4.0f * 0x1p-24f) - 0x1p-120f;
  if (!(left_m > 0.0f)) return {};
  return {left_m, hint.sign};
}

}  // namespace firmtouch::query
