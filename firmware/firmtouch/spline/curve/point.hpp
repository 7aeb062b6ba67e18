#pragma once
// Points of a curve's piece with their derivatives, for .cpp files of this module only.
#include "firmtouch/spline/layout.hpp"
#include "firmtouch/spline/numbers.hpp"

namespace firmtouch::spline {

/// A value and its derivatives by the piece's s.
template <class T>
struct Jet {
  T x, d1, d2, d3;
};
/// A point of a curve, from its piece's origin.
using CurvePoint = Jet<math::Vec3>;

/// A cubic, inline for the search. No term that is always 0 is computed.
template <class T>
static inline Jet<T> cubic_at(T c0, T c1, T c2, T c3, float s) {
  const T top = c3 * s, a = top + c2, b = a * s + c1, d = top + a;
  return {b * s + c0, d * s + b, (top + d) * 2.0f, c3 * 6.0f};
}
static inline CurvePoint cubic_at(const float* c, uint32_t stride, float s) {
  return cubic_at(vec3_at(c), vec3_at(c + stride), vec3_at(c + 2 * stride), vec3_at(c + 3 * stride),
                  s);
}

/// A point of any piece. The order of operations is part of the result; proof/leaf_shape.cpp bounds
/// what it loses.
CurvePoint evaluate(const Piece& piece, const float* coefficients, float s);

}  // namespace firmtouch::spline
