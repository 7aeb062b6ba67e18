#include "firmtouch/query/coherence.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::query {
namespace {

// What is left of a certified radius, rounded down; 0 where nothing is.
float left_of(float radius_m, float motion_m) {
  const float left_m = (radius_m - motion_m) * (1.0f - 4.0f * 0x1p-24f) - 0x1p-120f;
  return left_m > 0.0f ? left_m : 0.0f;
}

}  // namespace

Carried carry(const Hint& hint, math::Vec3 position_m) {
  const math::Vec3 step = position_m - hint.position_m;
  // The motion rounded up (five operations of relative error 2^-24 each), what is left of the
  // radius rounded down.
  const float motion_m = math::length(step) * (1.0f + 8.0f * 0x1p-24f);
  Carried carried;
  if (!(motion_m <= 0x1p100f)) return carried;
  carried.motion_m = motion_m;
  carried.lower_m = left_of(hint.lower_m, motion_m);
  carried.fence_m = left_of(hint.fence_m, motion_m);
  if (carried.lower_m > 0.0f) carried.sign = hint.sign;
  return carried;
}

}  // namespace firmtouch::query
