#pragma once
// Points of a piece with their derivatives, for .cpp files of this room only. The order of
// operations is part of the result; what it loses is reckoned in leaf_shape.cpp.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// A point of a curve, from its piece's origin, and its derivatives by the piece's s.
struct CurvePoint {
  math::Vec3 x, d1, d2;
};

/// A point of a surface and its derivatives by the piece's s and t.
struct SurfacePoint {
  math::Vec3 x, du, dv, duu, duv, dvv;
};

static inline math::Vec3 vec3_at(const float* from) { return {from[0], from[1], from[2]}; }

/// A polynomial with its first derivative and half its second (Horner).
template <class T>
struct Jet {
  T value, first, half_second;
};
template <class T>
static inline void begin(Jet<T>& jet, T c) {
  jet.value = c;
  jet.first = jet.half_second = T{};
}
template <class T>
static inline void add_power(Jet<T>& jet, T c, float s) {
  jet.half_second = jet.half_second * s + jet.first;
  jet.first = jet.first * s + jet.value;
  jet.value = jet.value * s + c;
}

/// Numerator over weight, with the derivatives of both (Leibniz' rule).
static inline void divide(CurvePoint& point, float w, float w1, float w2) {
  const float per_w = 1.0f / w;
  point.x = point.x * per_w;
  point.d1 = (point.d1 - point.x * w1) * per_w;
  point.d2 = (point.d2 - point.d1 * (2.0f * w1) - point.x * w2) * per_w;
}

static inline void evaluate_cubic(const float* c, float s, CurvePoint& point) {
  const math::Vec3 c1 = vec3_at(c + 3), c2 = vec3_at(c + 6), c3 = vec3_at(c + 9);
  const math::Vec3 a = c3 * s + c2, b = a * s + c1;
  const math::Vec3 d = c3 * s + a;
  point.x = b * s + vec3_at(c);
  point.d1 = d * s + b;
  point.d2 = (c3 * s + d) * 2.0f;
}

static inline void evaluate(const Piece& piece, const float* coefficients, float s,
                            CurvePoint& point) {
  const float* c = coefficients + piece.coefficients;
  if (piece.degree_u == 3 && piece.is_rational == 0) return evaluate_cubic(c, s, point);
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  c += piece.degree_u * stride;
  Jet<math::Vec3> jet;
  Jet<float> weight;
  begin(jet, vec3_at(c));
  begin(weight, piece.is_rational != 0 ? c[3] : 1.0f);
  for (uint32_t k = piece.degree_u; k > 0; --k) {
    c -= stride;
    add_power(jet, vec3_at(c), s);
    if (piece.is_rational != 0) add_power(weight, c[3], s);
  }
  point.x = jet.value;
  point.d1 = jet.first;
  point.d2 = jet.half_second * 2.0f;
  if (piece.is_rational != 0) divide(point, weight.value, weight.first, weight.half_second * 2.0f);
}

/// The numerator's derivatives become the point's; `w`: the weight's own, in the order of SurfacePoint.
static inline void divide(SurfacePoint& p, const float (&w)[6]) {
  const float per_w = 1.0f / w[0];
  p.x = p.x * per_w;
  p.du = (p.du - p.x * w[1]) * per_w;
  p.dv = (p.dv - p.x * w[2]) * per_w;
  p.duu = (p.duu - p.du * (2.0f * w[1]) - p.x * w[3]) * per_w;
  p.duv = (p.duv - p.du * w[2] - p.dv * w[1] - p.x * w[4]) * per_w;
  p.dvv = (p.dvv - p.dv * (2.0f * w[2]) - p.x * w[5]) * per_w;
}

/// A row of powers of s, and the rows before it by powers of t.
template <class T>
struct Rows {
  T x{}, du{}, dv{}, half_duu{}, duv{}, half_dvv{};
  void add(const Jet<T>& row, float t) {
    half_dvv = half_dvv * t + dv;
    dv = dv * t + x;
    x = x * t + row.value;
    duv = duv * t + du;
    du = du * t + row.first;
    half_duu = half_duu * t + row.half_second;
  }
};

static inline void cubic_row(const float* c, float s, Jet<math::Vec3>& jet) {
  const math::Vec3 c1 = vec3_at(c + 3), c2 = vec3_at(c + 6), c3 = vec3_at(c + 9);
  const math::Vec3 top = c3 * s, a = top + c2, b = a * s + c1, d = top + a;
  jet.value = b * s + vec3_at(c);
  jet.first = d * s + b;
  jet.half_second = top + d;
}

static inline void evaluate(const Piece& piece, const float* coefficients, float s, float t,
                            SurfacePoint& point) {
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3, columns = piece.degree_u + 1u;
  const float* row = coefficients + piece.coefficients + piece.degree_v * columns * stride;
  Rows<math::Vec3> rows;
  Rows<float> weights;
  for (uint32_t j = piece.degree_v + 1u; j > 0; --j, row -= columns * stride) {
    Jet<math::Vec3> jet;
    if (piece.degree_u == 3 && piece.is_rational == 0) {
      cubic_row(row, s, jet);
      rows.add(jet, t);
      continue;
    }
    const float* c = row + piece.degree_u * stride;
    Jet<float> weight;
    begin(jet, vec3_at(c));
    begin(weight, piece.is_rational != 0 ? c[3] : 0.0f);
    for (uint32_t k = piece.degree_u; k > 0; --k) {
      c -= stride;
      add_power(jet, vec3_at(c), s);
      if (piece.is_rational != 0) add_power(weight, c[3], s);
    }
    rows.add(jet, t);
    if (piece.is_rational != 0) weights.add(weight, t);
  }
  point = {rows.x, rows.du, rows.dv, rows.half_duu * 2.0f, rows.duv, rows.half_dvv * 2.0f};
  if (piece.is_rational != 0) {
    const float w[6] = {weights.x,   weights.du,
                        weights.dv,  weights.half_duu * 2.0f,
                        weights.duv, weights.half_dvv * 2.0f};
    divide(point, w);
  }
}

}  // namespace firmtouch::spline
