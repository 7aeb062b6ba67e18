#pragma once
#include <vector>

#include "footpoint/bernstein.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Equation (1), <C - P, C'> = 0, of a Bezier piece, times a power of its weight that makes it a
/// polynomial: A(t) - <P - origin, B(t)>, affine in P. B has the direction of C'.
struct CurveSystem {
  explicit CurveSystem(const BezierCurve& curve);

  /// Its Bernstein coefficients for a query.
  std::vector<double> coefficients(Point p_m) const;
  /// Below this a coefficient is rounding.
  double noise(Point p_m) const;
  /// Value and the derivative by t at a local parameter.
  void value(Point p_m, double t, double& f, double& slope) const;
  /// B(t): the gradient of -F by P.
  Point gradient(double t) const;
  Point point(double t) const { return point_at(piece, t); }

  BezierCurve piece;
  Point origin;
  Scalars a;
  Points b;
  Scalars a_slope;  // derivatives by t
  Points b_slope;
  double scale_a = 0, scale_b = 0;  // the largest coefficients
};

}  // namespace firmtouch::tools
