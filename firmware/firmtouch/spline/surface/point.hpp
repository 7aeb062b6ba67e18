#pragma once
// Points of a surface's piece with their derivatives, for .cpp files of this module only. The order
// of operations is part of the result; proof/leaf_shape.cpp bounds what it loses.
#include "firmtouch/math/isa.hpp"
#include "firmtouch/spline/layout.hpp"
#include "firmtouch/spline/numbers.hpp"

namespace firmtouch::spline {

/// A point of a surface, from its piece's origin, and its derivatives by the piece's s and t.
struct SurfacePoint {
  math::Vec3 x, du, dv, duu, duv, dvv, uuu, uuv, uvv, vvv;
};
static_assert(sizeof(SurfacePoint) == 30 * sizeof(float));

/// A point of a surface in any arithmetic.
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

/// A coordinate, or four, with its derivatives, those of an order k divided by k! of each axis.
/// Horner's rule along s in each row, then along t.
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

/// Evaluates a piece at s and t.
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
