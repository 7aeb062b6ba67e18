#pragma once
// Half the squared distance to a surface about one of its points, with what it may be off: for .cpp
// files of this module only.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

/// A rectangle of a piece, by its s and t.
struct Rectangle {
  float low[2], high[2];
  float start[2];  // where to evaluate first
};

/// D^2 / 2 = distance2 / 2 + slope . d + d . bend . d / 2 and a rest of third derivatives uuu, uuv,
/// uvv, vvv, at the point, and fourth ones, uuuu to vvvv, everywhere at most `fourth` in size,
/// those of even powers only downward, by the piece's s and t.
struct Quadratic {
  float distance2;
  float at[2];
  float slope[2];
  float bend[3];                // uu, uv, vv
  float gauss[3];               // the same of the tangents alone: never bent downward
  float slope_noise[2];         // by which a slope may be off
  float bend_noise[2];          // d . bend . d may be off by these times u^2 and v^2 together
  float third[4], third_noise;  // a third derivative may be off by the latter
  float fourth[5];

  /// By how much third derivatives may lower the rest, with what makes up for the fourth ones
  /// within U and V: u^3 v <= U u^2 v, and of u^2 v^2 half counts as V u^2 v, half as U u v^2.
  void changes(float u, float v, const float (&lows)[4], float (&change)[4]) const {
    change[0] = lows[0] + third_noise + fourth[0] * u * 0.25f;
    change[1] = lows[1] + third_noise + fourth[1] * u * 0.33333337f + fourth[2] * v * 0.25f;
    change[2] = lows[2] + third_noise + fourth[3] * v * 0.33333337f + fourth[2] * u * 0.25f;
    change[3] = lows[3] + third_noise + fourth[4] * v * 0.25f;
  }

  /// A lower bound of D^2 over a rectangle. With x and y from -1 to 1 of its reaches U and V, the
  /// rest is at least -(uuu U^3 |x|^3 + 3 uuv U^2 V x^2 |y| + 3 uvv U V^2 |x| y^2 + vvv V^3 |y|^3)
  /// / 6, which with the bend is a quadratic form Q of |x| and |y|: x^2 |y| is at most x^2, of the
  /// stronger axis, and at most |x y|, which spares the weaker one. On an axis that leads only away
  /// from the point and uphill, g |x| >= g x^2: the slope becomes part of Q. What is left of the
  /// slopes costs what Q leaves of it: the stronger axis wherever it ends, the other one within the
  /// rectangle, bent downward or not. Where an axis leads up more steeply than all that is mixed
  /// with it may take away, the other one is left alone: computed only where the rest is not
  /// `enough2`.
  float least2(const Rectangle& r, float enough2 = FLT_MAX) const {
    // By how much terms may lower the rest: those whose sign is known, on one side of the point, by
    // nothing where that leads up.
    struct Way {
      float reach, side;  // the latter 0 where the rectangle is on both sides
      float g, q;
      float own, other;  // of uuu or vvv, and of the term that turns with it
    };
    const auto way_along = [&](uint32_t k) {
      const float below = at[k] - r.low[k], above = r.high[k] - at[k];
      Way way;
      way.reach = math::larger(above, below);
      way.q = 0.0f;
      way.g = (__builtin_fabsf(slope[k]) + slope_noise[k]) * way.reach;
      const float own = third[3 * k], other = third[2 - k];
      if (math::smaller(above, below) > 0.0f) {
        way.side = 0.0f;
        way.own = __builtin_fabsf(own), way.other = __builtin_fabsf(other);
        return way;
      }
      way.side = below > 0.0f ? -1.0f : 1.0f;
      way.own = risen(-way.side * own), way.other = risen(-way.side * other);
      const float sure = (way.side * slope[k] - slope_noise[k]) * way.reach;
      if (sure > 0.0f) {
        way.q = 2.0f * sure;
        way.g = 0.0f;
      }
      return way;
    };
    const Way along_u = way_along(0), along_v = way_along(1);
    const float g[2] = {along_u.g, along_v.g}, q[2] = {along_u.q, along_v.q},
                reach[2] = {along_u.reach, along_v.reach};
    const float low_third[4] = {along_u.own, along_v.other, along_u.other, along_v.own};
    const float quarter = along_u.side * along_v.side;
    const float mixed =
        quarter * quarter > 0.0f ? risen(-quarter * bend[1]) : __builtin_fabsf(bend[1]);
    float change[4];
    changes(reach[0], reach[1], low_third, change);
    const float a_third = 0.33333337f;
    const float u2 = reach[0] * reach[0], v2 = reach[1] * reach[1], uv = reach[0] * reach[1];
    const float uuv = change[1] * reach[1] * u2, uvv = change[2] * reach[0] * v2;
    const float uu = (bend[0] - bend_noise[0] - change[0] * reach[0] * a_third) * u2;
    const float vv = (bend[2] - bend_noise[1] - change[3] * reach[1] * a_third) * v2;
    const float across = mixed * uv;
    const float a0 = uu + along_u.q, c0 = vv + along_v.q;
    const bool is_u_weak = a0 < c0;
    const float weak = is_u_weak ? a0 : c0, strong = is_u_weak ? c0 - uvv : a0 - uuv;
    float bound;
    if (strong > 0.0f) {
      const float b = across + 0.5f * (is_u_weak ? uuv : uvv);
      bound = is_u_weak ? min_across(weak, b, strong, g[0], g[1])
                        : min_across(weak, b, strong, g[1], g[0]);
    } else {
      bound = -0.5f * (risen(uuv - uu) + risen(uvv - vv)) - g[0] - g[1] - across;
    }
    const float first2 = distance2 + 2.0f * bound;
    if (first2 >= enough2 || !(q[0] + q[1] > 0.0f)) return first2;
    const float own[2] = {uu, vv}, mixed_in[2] = {uuv, uvv};
#pragma GCC unroll 2
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t o = 1 - k;
      if (!(q[k] > 0.0f)) continue;
      const float left = 0.5f * q[k] - across - 0.5f * mixed_in[o];
      const float at_end = left + 0.5f * (own[k] - mixed_in[k]);
      const float slack = 0x1p-20f * (q[k] + across + uuv + uvv + __builtin_fabsf(own[k]));
      if (!(left > slack && at_end > slack)) continue;
      bound = math::larger(min_along(0.5f * q[o], g[o], own[o]), bound);
    }
    return distance2 + 2.0f * bound;
  }

  /// Where Newton's method, within the rectangle, would look next: of the bend where it is positive
  /// on the axes that are free, else of the tangents alone. Result: by how much D^2 / 2 should be
  /// less there.
  float next(const Rectangle& r, float (&to)[2]) const {
    const float* h = bend;
    bool is_fixed[2];
    for (uint32_t k = 0; k < 2; ++k)
      is_fixed[k] =
          (at[k] <= r.low[k] && slope[k] > 0.0f) || (at[k] >= r.high[k] && slope[k] < 0.0f);
    const bool is_bowl = is_fixed[0]   ? h[2] > 0.0f
                         : is_fixed[1] ? h[0] > 0.0f
                                       : h[0] > 0.0f && h[2] > 0.0f &&
                                             h[0] * h[2] - h[1] * h[1] > 0x1p-10f * (h[0] * h[2]);
    if (!is_bowl) h = gauss;
    float step[2] = {0.0f, 0.0f};
    const float determinant = h[0] * h[2] - h[1] * h[1];
    if (!is_fixed[0] && !is_fixed[1] && determinant > 0.0f) {
      step[0] = (h[1] * slope[1] - h[2] * slope[0]) / determinant;
      step[1] = (h[1] * slope[0] - h[0] * slope[1]) / determinant;
      // Where one axis ends, the other is solved anew along the edge; where both do, along the
      // better one.
      const float wanted[2] = {at[0] + step[0], at[1] + step[1]};
      float most = -FLT_MAX;
#pragma GCC unroll 2
      for (uint32_t k = 0; k < 2; ++k) {
        const float held = clamped(wanted[k], r, k);
        if (!(held < wanted[k] || held > wanted[k])) continue;
        const uint32_t o = 1 - k;
        const float x = held - at[k], diagonal = h[2 * o];
        const float y = clamped(at[o] - (slope[o] + h[1] * x) / diagonal, r, o) - at[o];
        const float gain = gain_of(h, k == 0 ? x : y, k == 0 ? y : x);
        if (!(gain > most)) continue;
        most = gain;
        step[k] = x;
        step[o] = y;
      }
    } else {
      for (uint32_t k = 0; k < 2; ++k)
        if (!is_fixed[k] && h[2 * k] > 0.0f) step[k] = -slope[k] / h[2 * k];
    }
#pragma GCC unroll 2
    for (uint32_t k = 0; k < 2; ++k) {
      to[k] = clamped(at[k] + step[k], r, k);
      step[k] = to[k] - at[k];
    }
    return gain_of(h, step[0], step[1]);
  }
  float gain_of(const float* h, float u, float v) const {
    return -(slope[0] * u + slope[1] * v) - 0.5f * (h[0] * u * u + h[2] * v * v) - h[1] * u * v;
  }

  /// The axis on which more of the doubt lies, over half of the rectangle: what is to be halved.
  uint32_t doubtful_axis(const Rectangle& r) const {
    const float u = 0.5f * (r.high[0] - r.low[0]), v = 0.5f * (r.high[1] - r.low[1]);
    float change[4];
    const float low_third[4] = {__builtin_fabsf(third[0]), __builtin_fabsf(third[1]),
                                __builtin_fabsf(third[2]), __builtin_fabsf(third[3])};
    changes(u, v, low_third, change);
    const float of_u = (change[0] * u * 0.33333337f + change[1] * v + bend_noise[0]) * (u * u);
    const float of_v = (change[3] * v * 0.33333337f + change[2] * u + bend_noise[1]) * (v * v);
    return of_u >= of_v ? 0 : 1;
  }

  /// At most the least of x rise - x fall + x^2 own / 2 over x from 0 to 1, of which rise or fall
  /// is 0.
  static float min_along(float rise, float fall, float own) {
    if (own > fall) return -0.5f * (fall * fall / own) * (1.0f + 0x1p-20f);
    const float end = rise + 0.5f * own - fall;
    return end > 0x1p-20f * rise ? 0.0f : end - 0x1p-22f * rise;
  }

  /// At most the least of -(g x + h y) + (a x^2 - 2 b x y + c y^2) / 2 over x and y from 0 to 1,
  /// where c > 0: of any y where that may be less than 1, else of y = 1.
  static float min_across(float a, float b, float c, float g, float h) {
    const bool is_within = h < c;
    const float turned = is_within ? b / c : 1.0f, own = is_within ? a - b * turned : a;
    const float sure = own - 0x1p-20f * (__builtin_fabsf(a) + b * turned);
    const float slope = g + turned * (is_within ? h : b);
    const float along = sure > slope ? 0.5f * (slope * slope / sure) : slope - 0.5f * sure;
    const float lost = (is_within ? 0.5f * (h * h / c) : h - 0.5f * c) + along;
    return -lost * (1.0f + 0x1p-18f);
  }

  static float risen(float value) { return math::larger(value, 0.0f); }
  static float clamped(float value, const Rectangle& r, uint32_t k) {
    const float above = math::larger(value, r.low[k]);
    return above < r.high[k] ? above : r.high[k];
  }
};

}  // namespace firmtouch::spline
