#pragma once
// Half the squared distance about a point of a surface with all that bounds its rest, for .cpp
// files of this module only.
#include "firmtouch/spline/surface/point.hpp"
#include "firmtouch/spline/surface/quadratic.hpp"

namespace firmtouch::spline {

/// A cell's bounds of the fourth derivatives, as PatchBend says.
struct SurfaceBends {
  float fixed[5], turning[5];
};

/// By what factors the derivatives of a surface's point lose more than the point itself.
struct DerivativeNoise {
  float first, second, mixed, third;
};
/// Of degree 3 at most, without weights: each term is rounded no more often than the point's
/// (evaluation.hpp), and carries k, k (k - 1), k l and k (k - 1) l more. Else: search.hpp.
static inline DerivativeNoise noise_of(const Piece& piece) {
  if (piece.is_rational == 0 && piece.degree_u <= 3 && piece.degree_v <= 3)
    return {3.0f, 6.0f, 9.0f, 18.0f};
  return {kSlopeNoise, kBendNoise, kBendNoise, kTwistNoise};
}

/// All but `at` and distance2, which is r_m's, from the query to the point.
static inline void expand_about(const SurfacePoint& point, math::Vec3 r_m, float loss_m,
                                const DerivativeNoise& noise, const SurfaceBends& bends,
                                Quadratic& f) {
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
  const float loss_up_m = loss_m * kUp, away_m = distance_m + loss_m;
  const float both_m2 = noise.first * loss_up_m * away_m;
  f.slope_noise[0] = speed_u * lost_m + both_m2;
  f.slope_noise[1] = speed_v * lost_m + both_m2;
  // The noise of the mixed derivative is shared between the two axes: 2 |u v| <= u^2 + v^2.
  const float swing_u = size_of(point.duu), swing_v = size_of(point.dvv);
  const float swing_both = size_of(point.duv), speeds = speed_u + speed_v;
  const float mixed = noise.first * speeds + noise.mixed * away_m;
  const float once = 2.0f * noise.first, twice = noise.second * away_m;
  const float rounded = 8.0f * kUnit * kUp, mixed_speed = speed_u * speed_v;
  f.bend_noise[0] = loss_up_m * (once * speed_u + twice + mixed) + lost_m * (swing_u + swing_both) +
                    rounded * (f.gauss[0] + mixed_speed);
  f.bend_noise[1] = loss_up_m * (once * speed_v + twice + mixed) + lost_m * (swing_v + swing_both) +
                    rounded * (f.gauss[2] + mixed_speed);
  const float swings = swing_u + swing_both + swing_v;
  const float twists =
      size_of(point.uuu) + size_of(point.uuv) + size_of(point.uvv) + size_of(point.vvv);
  f.third_noise =
      ((3.0f * noise.first * swings + 3.0f * noise.mixed * speeds + noise.third * away_m) * loss_m +
       lost_m * twists + 24.0f * kUnit * (3.0f * speeds * swings + distance_m * twists)) *
      kUp;
#pragma GCC unroll 5
  for (uint32_t k = 0; k < 5; ++k)
    f.fourth[k] = (bends.fixed[k] + bends.turning[k] * distance_m) * kUp;
}

}  // namespace firmtouch::spline
