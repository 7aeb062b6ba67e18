#pragma once
// Half the squared distance about a point of a surface with all that bounds its rest, for .cpp files of this
// room only.
#include "firmtouch/spline/evaluation.hpp"
#include "firmtouch/spline/quadratic.hpp"

namespace firmtouch::spline {

/// A cell's bounds of the fourth derivatives, as PatchBend says.
struct SurfaceBends {
  float fixed[5], turning[5];
};

/// All but `at` and distance2, which is r_m's, from the query to the point.
static inline void expand_about(const SurfacePoint& point, math::Vec3 r_m, float loss_m,
                                const SurfaceBends& bends, Quadratic& f) {
  constexpr float kUp = 1.0f + 0x1p-16f;  // for sums and products of a few dozen roundings
  f.slope[0] = dot(r_m, point.du);
  f.slope[1] = dot(r_m, point.dv);
  f.gauss[0] = dot(point.du, point.du);
  f.gauss[1] = dot(point.du, point.dv);
  f.gauss[2] = dot(point.dv, point.dv);
  f.bend[0] = f.gauss[0] + dot(r_m, point.duu);
  f.bend[1] = f.gauss[1] + dot(r_m, point.duv);
  f.bend[2] = f.gauss[2] + dot(r_m, point.dvv);
  f.third[0] = 3.0f * dot(point.du, point.duu) + dot(r_m, point.uuu);
  f.third[1] = dot(point.dv, point.duu) + 2.0f * dot(point.du, point.duv) + dot(r_m, point.uuv);
  f.third[2] = dot(point.du, point.dvv) + 2.0f * dot(point.dv, point.duv) + dot(r_m, point.uvv);
  f.third[3] = 3.0f * dot(point.dv, point.dvv) + dot(r_m, point.vvv);
  const float distance_m = math::square_root(f.distance2);
  const float speed_u = math::square_root(f.gauss[0]), speed_v = math::square_root(f.gauss[2]);
  const float lost_m = (loss_m + 6.0f * kUnit * distance_m) * kUp;
  const float both_m2 = kSlopeNoise * loss_m * distance_m;
  f.slope_noise[0] = speed_u * lost_m + both_m2;
  f.slope_noise[1] = speed_v * lost_m + both_m2;
  // The noise of the mixed derivative is shared between the two axes: 2 |u v| <= u^2 + v^2.
  const float swing_u = size_of(point.duu), swing_v = size_of(point.dvv);
  const float swing_both = size_of(point.duv), speeds = speed_u + speed_v;
  const float mixed = speed_u * speed_v + distance_m * swing_both;
  const float turned = kBendNoise * loss_m * kUp, rounded = 16.0f * kUnit * kUp;
  f.bend_noise[0] = turned * (2.0f * (speed_u + distance_m) + speeds) +
                    rounded * (f.gauss[0] + distance_m * swing_u + mixed);
  f.bend_noise[1] = turned * (2.0f * (speed_v + distance_m) + speeds) +
                    rounded * (f.gauss[2] + distance_m * swing_v + mixed);
  const float swings = swing_u + swing_both + swing_v;
  const float twists =
      size_of(point.uuu) + size_of(point.uuv) + size_of(point.uvv) + size_of(point.vvv);
  f.third_noise =
      ((3.0f * kSlopeNoise * swings + 3.0f * kBendNoise * speeds + kTwistNoise * distance_m) *
           loss_m +
       lost_m * twists + 24.0f * kUnit * (3.0f * speeds * swings + distance_m * twists)) *
      kUp;
  for (uint32_t k = 0; k < 5; ++k)
    f.fourth[k] = (bends.fixed[k] + bends.turning[k] * distance_m) * kUp;
}

}  // namespace firmtouch::spline
