#pragma once
// What the derivatives at a point of a curve prove of the points about it, for .cpp files of this
// module only.
#include "firmtouch/spline/curve/tree.hpp"

namespace firmtouch::spline {

/// D^2 / 2 about a point: its slope, its bend as small as it may be, a third of its third
/// derivative and a twelfth of how far the fourth may be below 0 on all of the piece.
struct Expansion {
  float distance2, slope, slope_noise, min_bend, noise, third_3, fourth_12;

  /// The bend as far as it counts on one side, over a length: with the sign of the side in slope
  /// and third,
  ///     f(d) >= f + slope d + (bend + third d / 3 - fourth d^2 / 12) d^2 / 2,
  /// where what is added to the bend is concave in d: least at an end. Lengths are at most 2: what
  /// the third derivative is off by is in the bend's noise already.
  float bend_over(float side, float length) const {
    const float fall = math::larger(fourth_12 * length - side * third_3, 0.0f);
    return min_bend - fall * length;
  }
  /// The same of the second derivative itself, bend + third d - fourth d^2 / 2.
  float min_bend_over(float side, float length) const {
    const float change = 3.0f * (side * third_3) - 6.0f * fourth_12 * length;
    return min_bend - 2.0f * noise + (change < 0.0f ? change * length : 0.0f);
  }
  /// The least of D^2 on one side (1: rising s, -1: falling), over a length.
  float least2(float side, float length) const {
    const float g = side * slope - slope_noise;
    const float q = bend_over(side, length);
    if (q > 0.0f && g < 0.0f && -g < q * length) return distance2 - g * (g / q);
    return distance2 - math::larger(-(2.0f * g + q * length) * length, 0.0f);
  }
};

/// `r_m`: from the query to the point; `speed2` and `bend`: of the curve, and of D^2 / 2 there;
/// `stored`: of the piece; `loss_m`: of the model.
static inline Expansion expand(const CurvePoint& at, math::Vec3 r_m, float distance2, float slope,
                               float speed2, float bend, const CurveBend& stored, float loss_m) {
  const float distance_m = math::square_root(distance2);
  const float speed = math::square_root(speed2) * (1.0f + 0x1p-20f);
  Expansion f;
  f.distance2 = distance2;
  f.slope = slope;
  f.slope_noise = speed * (loss_m + 6.0f * kUnit * distance_m) + kSlopeNoise * loss_m * distance_m;
  f.noise = stored.noise_m2 + stored.noise_turning_m * distance_m;
  f.min_bend = bend - f.noise;
  f.third_3 = dot(at.d1, at.d2) + 0.33333334f * dot(r_m, at.d3);
  f.fourth_12 = (stored.fixed_m2 + stored.turning_m * distance_m) * 0.083333343f;
  return f;
}

}  // namespace firmtouch::spline
