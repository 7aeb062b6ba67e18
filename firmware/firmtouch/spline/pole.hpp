#pragma once
// How near the parts of a piece may be that has a pole, an edge that is one point: for .cpp files of this module only.
#include "firmtouch/spline/surface_parts.hpp"

namespace firmtouch::spline {

/// About a pole every part is about as near as the pole is, farther by less than its radius. With t along
/// the edge and y from it on, from 0 to 2, the piece is P + y w(t, y) with a polynomial w. From a query, with r = P - q,
///     |r + y w|^2 = r^2 + 2 y r . w + y^2 w^2 >= r^2 + 2 y g + y^2 l^2 / d^2,
/// where g and l > 0 are the least of r . w and of w . d over a part that reaches to the pole, for any d: here w in the part's
/// middle. Over y that is least at -g d^2 / l^2, or where the part ends before. Both polynomials are moved to the part's middle;
/// there an even power times its coefficient is not below the latter where it is below 0, else not below 0, and any other not below less
/// its size. What is not one point of the edge, at most the sizes of its coefficients, is taken off.
/// Of a cubic by a cubic without weights.
class Pole {
 public:
  Pole() {}  // by hand: else all is cleared

  /// Whether that edge of a piece is a pole, but for `max_m`. axis: 0 or 1, where u or v ends; is_high: at 1.
  bool begin(const float* c, math::Vec3 q_m, uint32_t axis, bool is_high, float max_m) {
    const uint32_t along = axis == 0 ? 12 : 3, across = axis == 0 ? 3 : 12;
    const float sign = is_high ? 1.0f : -1.0f;
    const auto end_of = [&](uint32_t i) {
      const float* const row = c + i * along;
      return (vec3_at(row) + vec3_at(row + 2 * across)) +
             (vec3_at(row + across) + vec3_at(row + 3 * across)) * sign;
    };
    const float* const last = c + 3 * along;  // mostly enough: one coordinate
    const float odd = last[across] + last[3 * across];
    if (!(__builtin_fabsf(last[0] + last[2 * across] + odd * sign) <= max_m)) return false;
    off_m_ = 0.0f;
    for (uint32_t i = 3; i > 0; --i) {
      off_m_ += size_of(end_of(i));
      if (!(off_m_ <= max_m)) return false;
    }
    float sizes_m = 0.0f;  // of all that is added up to the edge's points
    size_ = 0.0f;
    const math::Vec3 r_m = end_of(0) - q_m;
    float grown_i = 1.0f;
#pragma GCC unroll 4
    for (uint32_t i = 0; i < 4; ++i) {
      const float* const row = c + i * along;
      const math::Vec3 d1 = vec3_at(row + across) * sign, d2 = vec3_at(row + 2 * across),
                       d3 = vec3_at(row + 3 * across) * sign;
      const math::Vec3 of[3] = {-(d1 + d2 * 2.0f + d3 * 3.0f), d2 + d3 * 3.0f, -d3};
#pragma GCC unroll 3
      for (uint32_t k = 0; k < 3; ++k) {
        e_[i][k][0] = of[k].x, e_[i][k][1] = of[k].y, e_[i][k][2] = of[k].z;
        of_r_[i][k] = dot(r_m, of[k]);
      }
      const float s1 = size_of(d1), s2 = size_of(d2), s3 = size_of(d3);
      sizes_m += size_of(vec3_at(row)) + s1 + s2 + s3;
      // Of e by 2^i and 3^k, which is more than the powers of t and y moved to the middle come to.
      size_ += grown_i * ((s1 + 2.0f * s2 + 3.0f * s3) + 3.0f * (s2 + 3.0f * s3) + 9.0f * s3);
      grown_i = 2.0f * grown_i;
    }
    off_m_ += sizes_m * (6.0f * kUnit);
    r2_ = dot(r_m, r_m);
    r_size_m_ = size_of(r_m);
    r_m_[0] = r_m.x, r_m_[1] = r_m.y, r_m_[2] = r_m.z;
    return true;
  }

  /// A lower bound of the distance to what lies between those t, from the pole to `deep` of y. foot: where, of y, half-way
  /// along, the distance is about the least.
  [[gnu::always_inline]] float lower_m(float t_low, float t_high, float deep, float& foot) const {
    const float t = 0.5f * (t_low + t_high), half_t = 0.5f * (t_high - t_low), y = 0.5f * deep;
    math::Vec3 d{};
#pragma GCC unroll 4
    for (uint32_t i = 4; i-- > 0;)
      d = d * t + ((vec3_at(e_[i][2]) * y + vec3_at(e_[i][1])) * y + vec3_at(e_[i][0]));
    const float d2 = dot(d, d) + FLT_MIN, wanted = -dot(vec3_at(r_m_), d) / d2;
    foot = wanted > 0.0f ? wanted < deep ? wanted : deep : 0.0f;
    float of_d[4][3];
#pragma GCC unroll 4
    for (uint32_t i = 0; i < 4; ++i)
#pragma GCC unroll 3
      for (uint32_t k = 0; k < 3; ++k) of_d[i][k] = dot(d, vec3_at(e_[i][k]));
    // Some 25 roundings at most, of what is no larger than size_ times the other factor.
    const float lost = 0x1p-19f * size_;
    const float l = math::larger(least_of(of_d, t, half_t, y) - size_of(d) * lost, 0.0f);
    const float w2 = (l * l) / d2 * (1.0f - 0x1p-20f);
    const float g = least_of(of_r_, t, half_t, y) - r_size_m_ * lost;
    const float least2 = r2_ * (1.0f - 8.0f * kUnit) + change_to(deep, g, w2);
    if (!(least2 > 0.0f)) return 0.0f;
    return math::larger(math::square_root(least2) * (1.0f - 2.0f * kUnit) - off_m_, 0.0f);
  }

 private:
  // At most the least of y (2 g + y w2), from the pole on.
  static float change_to(float deep, float g, float w2) {
    constexpr float kUp = 1.0f + 0x1p-19f;
    if (!(g < 0.0f)) return 0.0f;
    return deep * w2 > -g ? -(g * g) / w2 * kUp : deep * (2.0f * g + deep * w2) * kUp;
  }
  // Of a polynomial by the powers of t and y, from the pole to twice y.
  [[gnu::always_inline]] static float least_of(const float (&of)[4][3], float t, float half_t,
                                               float y) {
    float c[3][4];
#pragma GCC unroll 4
    for (uint32_t i = 0; i < 4; ++i) {
      const float top = of[i][2], slope = top * y + of[i][1];
      c[0][i] = slope * y + of[i][0];
      c[1][i] = (slope + top * y) * y;
      c[2][i] = top * (y * y);
    }
    float least = 0.0f;
#pragma GCC unroll 3
    for (uint32_t k = 0; k < 3; ++k) {
      const float c3 = c[k][3], a2 = c3 * t + c[k][2], a1 = a2 * t + c[k][1];
      const float b2 = c3 * t + a2, b1 = b2 * t + a1, d2 = c3 * t + b2;
      const float at_0 = a1 * t + c[k][0];
      const float even = d2 * (half_t * half_t);
      const float odd =
          __builtin_fabsf(b1) * half_t + __builtin_fabsf(c3) * (half_t * half_t * half_t);
      if (k == 1)
        least -= __builtin_fabsf(at_0) + __builtin_fabsf(even) + odd;
      else
        least += (k == 0 ? at_0 : math::smaller(at_0, 0.0f)) + math::smaller(even, 0.0f) - odd;
    }
    return least;
  }

  float e_[4][3][3];  // of w, by the powers of t and y
  float r_m_[3], of_r_[4][3], r2_, r_size_m_, size_, off_m_;
};

/// The poles of a model's pieces, for one query. Two are kept: parts of neighbours about a pole are asked about in turn.
class Poles {
 public:
  Poles(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()), coefficients_(model.coefficients().data()), p_m_(p_m) {}

  /// Of a part at an edge of its piece that is a pole, but for max_m: a lower bound of its distance, else 0. x and y: where on
  /// it, from -1 to 1, the foot is thought to be; as they were where nothing is known.
  [[gnu::noinline]] float lower_m(uint32_t node, float max_m, float& x, float& y) {
    if ((node ^ last_->node) >> 16 != 0) find(node, max_m);
    const uint32_t edge = last_->edge, axis = edge >> 1, other = 1 - axis;
    if (edge == kNoEdge) return 0.0f;
    const PatchNode part = apart(pieces_[node >> 16], node);
    const bool is_high = (edge & 1u) != 0;
    const uint32_t at = axis == 0 ? part.u : part.v, made = axis == 0 ? part.made_u : part.made_v;
    if (at != (is_high ? (2u << made) - 1u : 1u << made)) return 0.0f;
    const Rectangle range = SurfaceParts::range_of(part, 0.0f, 0.0f);
    const float deep = range.high[axis] - range.low[axis];
    float foot;
    const float min_m = last_->pole.lower_m(range.low[other], range.high[other], deep, foot);
    const float on = 2.0f * foot / deep - 1.0f;
    (axis == 0 ? x : y) = is_high ? -on : on;
    return min_m;
  }

 private:
  static constexpr uint32_t kNoEdge = 4;
  struct OfPiece {
    Pole pole;
    uint32_t node = kNoNode;  // any of the piece
    uint32_t edge = kNoEdge;  // 0 and 1: where u ends, 2 and 3: where v does
  };

  void find(uint32_t node, float max_m) {
    last_ = last_ == found_ ? found_ + 1 : found_;
    if ((node ^ last_->node) >> 16 == 0) return;
    last_->node = node;
    last_->edge = kNoEdge;
    const Piece& piece = pieces_[node >> 16];
    if (!is_bicubic(piece) || piece.is_rational != 0) return;
    const math::Vec3 q_m = p_m_ - vec3_at(piece.origin_m);
    const float* const c = coefficients_ + piece.coefficients;
    for (uint32_t edge = 0; edge < kNoEdge && last_->edge == kNoEdge; ++edge)
      if (last_->pole.begin(c, q_m, edge >> 1, (edge & 1u) != 0, max_m)) last_->edge = edge;
  }

  const Piece* pieces_;
  const float* coefficients_;
  math::Vec3 p_m_;
  OfPiece found_[2];
  OfPiece* last_ = found_;
};

}  // namespace firmtouch::spline
