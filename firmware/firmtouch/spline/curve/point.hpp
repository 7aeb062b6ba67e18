#pragma once
// Points of a curve's piece with their derivatives.
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::spline {

/// A point of a curve, from its piece's origin, and its derivatives by the piece's s.
struct CurvePoint {
  math::Vec3 x, d1, d2, d3;
  CurvePoint() {}  // leaves the members unset: clearing them would cost a call
};

/// Evaluates a piece at s. The order of operations is part of the result; proof/leaf_shape.cpp
/// bounds what it loses.
void evaluate(const Piece& piece, const float* coefficients, float s, CurvePoint& point);

}  // namespace firmtouch::spline
