#pragma once
// Centre of a cell, to the bit, for baker, proof and query. For the library's own translation
// units.

#include "firmtouch/field/layout.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::field {

static inline float centre_on_axis(const Head& head, uint32_t axis, uint32_t i) {
  return head.low_m[axis] + (static_cast<float>(static_cast<int32_t>(i)) + 0.5f) * head.cell_m;
}

static inline math::Vec3 centre_of(const Head& head, uint32_t x, uint32_t y, uint32_t z) {
  return {centre_on_axis(head, 0, x), centre_on_axis(head, 1, y), centre_on_axis(head, 2, z)};
}

static inline float high_on_axis(const Head& head, uint32_t axis) {
  return head.low_m[axis] +
         static_cast<float>(static_cast<int32_t>(head.count[axis])) * head.cell_m;
}

/// How much a returned distance may fall short of the truth (mesh/closest_point.hpp), rounded up.
static inline float reported_slack_m(float distance_m, float diagonal_m) {
  return 5e-7f * (distance_m > diagonal_m ? distance_m : diagonal_m);
}

}  // namespace firmtouch::field
