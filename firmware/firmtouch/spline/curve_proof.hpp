#pragma once
// What the derivatives at a point of a curve prove of the points about it, for .cpp files of this room only.
#include "firmtouch/spline/curve_tree.hpp"

namespace firmtouch::spline {

/// D^2 / 2 about a point: its bend there as small as it may be, and how far the bend changes a unit
/// of s.
struct Expansion {
  float distance2, slope_noise, least_bend, change;

  // The least of D^2 on one side, over a length: outward slope and bend as small as they may be,
  // f(d) >= f + slope d + (bend - change length / 3) d^2 / 2, whose least over 0 to length is
  // told.
  float least2(float outward, float length) const {
    const float g = outward - slope_noise;
    const float q = least_bend - change * length * 0.33333337f;
    if (q > 0.0f && g < 0.0f && -g < q * length) return distance2 - g * (g / q);
    const float end = (2.0f * g + q * length) * length;
    return end < 0.0f ? distance2 + end : distance2;
  }
};

/// `d2`: the second derivative; `stored`: of the leaf; `loss_m`: of the model.
template <bool kFlat>
static inline Expansion expand(float distance2, float bend, float speed2, math::Vec3 d2,
                               const Bend& stored, float loss_m) {
  const float fixed = half_float(stored.fixed), turning = half_float(stored.turning);
  const float distance_m = math::square_root(distance2);
  const float speed = math::square_root(speed2) * (1.0f + 0x1p-20f), swing = size_as<kFlat>(d2);
  Expansion f;
  f.distance2 = distance2;
  f.slope_noise = speed * (loss_m + 6.0f * kUnit * distance_m) + kSlopeNoise * loss_m * distance_m;
  f.least_bend = bend - kBendNoise * loss_m * (speed + distance_m) -
                 8.0f * kUnit * (speed2 + distance_m * swing);
  f.change = (fixed + turning * distance_m) * (1.0f + 0x1p-20f);
  return f;
}

}  // namespace firmtouch::spline
