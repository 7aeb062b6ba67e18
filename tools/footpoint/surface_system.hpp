#pragma once
#include <vector>

#include "footpoint/bernstein.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Where both equations of a patch hold.
struct SurfaceRoot {
  double u, v;           // local, 0 to 1
  double det, diagonal;  // of the Jacobian: its determinant and its first element
};

/// Equations (3) and (4), <S - P, S_u> = <S - P, S_v> = 0, of a Bezier patch, made polynomials as
/// in CurveSystem. Where an edge is a single point the equation along it is divided by the distance
/// from that edge, which is what it vanishes with for every P.
struct SurfaceSystem {
  explicit SurfaceSystem(const BezierPatch& patch);

  /// Values and Jacobian at a local place: h, i, h_u, h_v, i_u, i_v.
  struct Values {
    double h, i, h_u, h_v, i_u, i_v;
  };
  Values values(Point p_m, double u, double v) const;
  /// Gradients of -H and -I by P.
  void gradients(double u, double v, Point& by_h, Point& by_i) const;

  /// All roots in the closed unit square and up to `more` beyond it, those taken to its edge, by
  /// subdivision of the Bernstein coefficients: boxes without a root are left where a coefficient's
  /// sign is the same throughout, also after the system is multiplied by its inverse Jacobian;
  /// boxes with at most one are found by a dominant diagonal and solved by Newton. `boxes` counts
  /// those looked at. `is_complete` is cleared where they were too many.
  void solve(Point p_m, std::vector<SurfaceRoot>& roots, size_t& boxes, bool& is_complete,
             double more = 1e-9) const;

  Point point(double u, double v) const { return point_at(patch, u, v); }

  BezierPatch patch;
  Point origin;
  Scalars a[2];  // of H and of I
  Points b[2];
  double scale_a[2] = {}, scale_b[2] = {};
};

}  // namespace firmtouch::tools
