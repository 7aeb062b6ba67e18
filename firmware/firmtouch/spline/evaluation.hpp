#pragma once
// Points of a piece with their derivatives, for .cpp files of this module only. The order of
// operations is part of the result; what it loses is reckoned in leaf_shape.cpp.
#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// A point of a curve, from its piece's origin, and its derivatives by the piece's s.
struct CurvePoint {
  math::Vec3 x, d1, d2, d3;
  CurvePoint() {}  // by hand: else all is cleared by a call, and then set
};

/// A point of a surface and its derivatives by the piece's s and t.
struct SurfacePoint {
  math::Vec3 x, du, dv, duu, duv, dvv, uuu, uuv, uvv, vvv;
};
static_assert(sizeof(SurfacePoint) == 30 * sizeof(float));

static inline math::Vec3 vec3_at(const float* from) { return {from[0], from[1], from[2]}; }

/// A polynomial with its first derivative, half its second and a sixth of its third (Horner).
template <class T>
struct Jet {
  T value, first, half_second, sixth_third;
};
template <class T>
static inline void begin(Jet<T>& jet, T c) {
  jet.value = c;
  jet.first = jet.half_second = jet.sixth_third = T{};
}
template <class T>
static inline void add_power(Jet<T>& jet, T c, float s) {
  jet.sixth_third = jet.sixth_third * s + jet.half_second;
  jet.half_second = jet.half_second * s + jet.first;
  jet.first = jet.first * s + jet.value;
  jet.value = jet.value * s + c;
}

/// Numerator over weight, with the derivatives of both (Leibniz' rule).
template <bool kThird>
static inline void divide(float& x, float& d1, float& d2, float& d3, float per_w, float w1,
                          float w2, float w3) {
  x = x * per_w;
  d1 = (d1 - x * w1) * per_w;
  d2 = (d2 - d1 * (2.0f * w1) - x * w2) * per_w;
  if constexpr (kThird) d3 = (d3 - d2 * (3.0f * w1) - d1 * (3.0f * w2) - x * w3) * per_w;
}
template <bool kFlat, bool kThird>
static inline void divide(CurvePoint& p, float w, float w1, float w2, float w3) {
  const float per_w = 1.0f / w;
  divide<kThird>(p.x.x, p.d1.x, p.d2.x, p.d3.x, per_w, w1, w2, w3);
  divide<kThird>(p.x.y, p.d1.y, p.d2.y, p.d3.y, per_w, w1, w2, w3);
  if constexpr (!kFlat) divide<kThird>(p.x.z, p.d1.z, p.d2.z, p.d3.z, per_w, w1, w2, w3);
}

/// One coordinate of a cubic with its derivatives: nothing is computed of what is 0.
static inline void cubic_at(const float* c, uint32_t stride, float s, float& x, float& d1,
                            float& d2, float& d3) {
  const float top = c[3 * stride] * s, a = top + c[2 * stride], b = a * s + c[stride];
  const float d = top + a;
  x = b * s + c[0];
  d1 = d * s + b;
  d2 = (top + d) * 2.0f;
  d3 = c[3 * stride] * 6.0f;
}

/// kFlat: z is left out.
template <bool kFlat>
static inline void evaluate_cubic(const float* c, uint32_t stride, float s, CurvePoint& point) {
  cubic_at(c, stride, s, point.x.x, point.d1.x, point.d2.x, point.d3.x);
  cubic_at(c + 1, stride, s, point.x.y, point.d1.y, point.d2.y, point.d3.y);
  if constexpr (!kFlat) cubic_at(c + 2, stride, s, point.x.z, point.d1.z, point.d2.z, point.d3.z);
}

static inline void evaluate_any(const Piece& piece, const float* c, float s, CurvePoint& point) {
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
  point.d3 = jet.sixth_third * 6.0f;
  if (piece.is_rational != 0)
    divide<false, true>(point, weight.value, weight.first, weight.half_second * 2.0f,
                        weight.sixth_third * 6.0f);
}

/// kThird: with the third derivative; else that is not to be used.
template <bool kFlat, bool kThird = true>
static inline void evaluate_as(const Piece& piece, const float* coefficients, float s,
                               CurvePoint& point) {
  const float* c = coefficients + piece.coefficients;
  if (piece.degree_u != 3) {
    CurvePoint any;  // of its own: else each would have to be stored
    evaluate_any(piece, c, s, any);
    point = any;
    return;
  }
  if (piece.is_rational == 0) return evaluate_cubic<kFlat>(c, 3, s, point);
  evaluate_cubic<kFlat>(c, 4, s, point);
  float w, w1, w2, w3;
  cubic_at(c + 3, 4, s, w, w1, w2, w3);
  divide<kFlat, kThird>(point, w, w1, w2, w3);
}

static inline void evaluate(const Piece& piece, const float* coefficients, float s,
                            CurvePoint& point) {
  evaluate_as<false>(piece, coefficients, s, point);
}

/// A point of a surface in any arithmetic: of each coordinate by itself, or of four side by side.
template <class T>
struct Derivatives {
  T x, du, dv, duu, duv, dvv, uuu, uuv, uvv, vvv;
};

/// The numerator's derivatives become the point's; `w`: the weight's own.
template <class T>
static inline void divide(T& p, const Derivatives<float>& w) {
  const float per_w = 1.0f / w.x;
  p.x = p.x * per_w;
  p.du = (p.du - p.x * w.du) * per_w;
  p.dv = (p.dv - p.x * w.dv) * per_w;
  p.duu = (p.duu - p.du * (2.0f * w.du) - p.x * w.duu) * per_w;
  p.duv = (p.duv - p.du * w.dv - p.dv * w.du - p.x * w.duv) * per_w;
  p.dvv = (p.dvv - p.dv * (2.0f * w.dv) - p.x * w.dvv) * per_w;
  p.uuu = (p.uuu - p.duu * (3.0f * w.du) - p.du * (3.0f * w.duu) - p.x * w.uuu) * per_w;
  p.uuv = (p.uuv - p.duu * w.dv - p.duv * (2.0f * w.du) - p.du * (2.0f * w.duv) - p.dv * w.duu -
           p.x * w.uuv) *
          per_w;
  p.uvv = (p.uvv - p.dvv * w.du - p.duv * (2.0f * w.dv) - p.dv * (2.0f * w.duv) - p.du * w.dvv -
           p.x * w.uvv) *
          per_w;
  p.vvv = (p.vvv - p.dvv * (3.0f * w.dv) - p.dv * (3.0f * w.dvv) - p.x * w.vvv) * per_w;
}

/// A coordinate, or four, with its derivatives, those of an order k divided by k! of each axis. Horner's
/// rule along s in each row, then along t.
template <class T>
struct Rows {
  T x, u, v, uu, uv, vv, uuu, uuv, uvv, vvv;
  void begin(T value, T first, T second, T third) {
    x = value, u = first, uu = second, uuu = third;
    v = uv = uuv = vv = uvv = vvv = T{};
  }
  void add(T value, T first, T second, T third, float t) {
    vvv = vvv * t + vv;
    vv = vv * t + v;
    v = v * t + x;
    x = x * t + value;
    uvv = uvv * t + uv;
    uv = uv * t + u;
    u = u * t + first;
    uuv = uuv * t + uu;
    uu = uu * t + second;
    uuu = uuu * t + third;
  }
  Derivatives<T> derivatives() const {
    return {x, u, v, 2.0f * uu, uv, 2.0f * vv, 6.0f * uuu, 2.0f * uuv, 2.0f * uvv, 6.0f * vvv};
  }
};

/// The same of a cubic by a cubic: nothing is computed of what is 0. at(i): coefficient i.
template <class T, class At>
static inline void cubic_rows(const At& at, float s, float t, Rows<T>& r) {
  const auto row = [&at, s](uint32_t j, T& value, T& first, T& second, T& third) {
    third = at(4 * j + 3);
    const T top = third * s, a = top + at(4 * j + 2), b = a * s + at(4 * j + 1), d = top + a;
    value = b * s + at(4 * j);
    first = d * s + b;
    second = top + d;
  };
  T x3, u3, uu3, uuu3, x2, u2, uu2, uuu2, x1, u1, uu1, uuu1, x0, u0, uu0, uuu0;
  row(3, x3, u3, uu3, uuu3);
  row(2, x2, u2, uu2, uuu2);
  x2 = x3 * t + x2, u2 = u3 * t + u2, uu2 = uu3 * t + uu2, uuu2 = uuu3 * t + uuu2;
  row(1, x1, u1, uu1, uuu1);
  const T v1 = x3 * t + x2, uv1 = u3 * t + u2, uuv1 = uu3 * t + uu2;
  x1 = x2 * t + x1, u1 = u2 * t + u1, uu1 = uu2 * t + uu1, uuu1 = uuu2 * t + uuu1;
  row(0, x0, u0, uu0, uuu0);
  r.vvv = x3;
  r.vv = x3 * t + v1;
  r.v = v1 * t + x1;
  r.x = x1 * t + x0;
  r.uvv = u3 * t + uv1;
  r.uv = uv1 * t + u1;
  r.u = u1 * t + u0;
  r.uuv = uuv1 * t + uu1;
  r.uu = uu1 * t + uu0;
  r.uuu = uuu1 * t + uuu0;
}

template <class T, class At>
static inline void any_rows(const Piece& piece, const At& at, float s, float t, Rows<T>& r) {
  const uint32_t columns = piece.degree_u + 1u;
  for (uint32_t j = columns * piece.degree_v, rows = 0; rows <= piece.degree_v;
       ++rows, j -= columns) {
    T value{}, first{}, second{}, third{};
    for (uint32_t k = columns; k-- > 0;) {
      third = third * s + second;
      second = second * s + first;
      first = first * s + value;
      value = value * s + at(j + k);
    }
    if (rows == 0)
      r.begin(value, first, second, third);
    else
      r.add(value, first, second, third, t);
  }
}

static inline bool is_bicubic(const Piece& piece) {
  return piece.degree_u == 3 && piece.degree_v == 3;
}

/// One coordinate after the other.
static inline void evaluate(const Piece& piece, const float* coefficients, float s, float t,
                            SurfacePoint& point) {
  const float* const c = coefficients + piece.coefficients;
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  float* const to = &point.x.x;  // ten vectors in a row
  Rows<float> r;
  const auto find = [&](uint32_t k) {
    if (is_bicubic(piece) && stride == 3)
      cubic_rows([c, k](uint32_t i) { return c[3 * i + k]; }, s, t, r);
    else if (is_bicubic(piece))
      cubic_rows([c, k](uint32_t i) { return c[4 * i + k]; }, s, t, r);
    else
      any_rows(
          piece, [c, k, stride](uint32_t i) { return c[stride * i + k]; }, s, t, r);
  };
#pragma GCC unroll 3
  for (uint32_t k = 0; k < 3; ++k) {
    find(k);
    to[k] = r.x, to[3 + k] = r.u, to[6 + k] = r.v;
    to[9 + k] = 2.0f * r.uu, to[12 + k] = r.uv, to[15 + k] = 2.0f * r.vv;
    to[18 + k] = 6.0f * r.uuu, to[21 + k] = 2.0f * r.uuv;
    to[24 + k] = 2.0f * r.uvv, to[27 + k] = 6.0f * r.vvv;
  }
  if (piece.is_rational == 0) return;
  find(3);
  divide(point, r.derivatives());
}

}  // namespace firmtouch::spline
