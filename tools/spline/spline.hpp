#pragma once
#include <string>
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// A control point of a NURBS or of a rational Bezier piece: where it is, and how strongly it
/// pulls.
struct ControlPoint {
  double x = 0, y = 0, z = 0;  // metres, not multiplied by the weight
  double w = 1;                // > 0
};

/// A curve of a file. Its knots are points.size() + degree + 1 and do not decrease; it is used from
/// `t0` to `t1`, which lie within knots[degree] and knots[points.size()].
struct SplineCurve {
  int degree = 0;
  std::vector<double> knots;
  std::vector<ControlPoint> points;
  double t0 = 0, t1 = 1;
  bool is_planar =
      false;          // every point within 1e-9 of the extent of a plane, found from the points
  int piece = 0;      // entity in file order from 0, curves and surfaces counted together
  std::string where;  // for messages: "entity 126 in line 14", "patch 3 in line 5"
};

/// A surface of a file, used from (u0, v0) to (u1, v1).
struct SplineSurface {
  int degree_u = 0, degree_v = 0;
  std::vector<double> knots_u, knots_v;
  std::vector<ControlPoint> points;  // u fastest: point (i, j) is points[j * count_u + i]
  size_t count_u = 0, count_v = 0;
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  int piece = 0;
  std::string where;
  bool is_turned = false;  // its normal is against u x v: so that it agrees with its neighbours
};

/// What a file holds: the answer of read_spline_file() (spline/read_spline.hpp).
struct SplineModel {
  std::vector<SplineCurve> curves;      // their `piece` rises
  std::vector<SplineSurface> surfaces;  // theirs too
  std::vector<std::string> notes;       // remarks for the report of a bake
  std::string problem;  // empty: usable; else file, entity, line, what is wrong, how to mend it
};

/// A piece of a curve between two knots: points.size() == degree + 1, in the parameter
/// (t - t0) / (t1 - t0) from 0 to 1.
struct BezierCurve {
  int degree = 0;
  std::vector<ControlPoint> points;
  double t0 = 0, t1 = 1;  // of the curve's own parameter
  int piece = 0;
};

/// A piece of a surface between knot lines; points u fastest, (degree_u + 1) * (degree_v + 1).
struct BezierPatch {
  int degree_u = 0, degree_v = 0;
  std::vector<ControlPoint> points;
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  int piece = 0;
};

/// Whether the weights differ. Where they do not, every piece has weights of exactly 1.
bool is_rational(const std::vector<ControlPoint>& points);

/// The Bezier pieces of a curve in the order of its parameter, each by knot insertion in double.
/// Result: pieces that meet have the same end point to the bit. A piece all of whose points
/// coincide is left out, so that nothing is left of a curve without length.
std::vector<BezierCurve> bezier_pieces(const SplineCurve& curve);

/// The Bezier pieces of a surface, u fastest. Neighbours have the same edge to the bit. A piece all
/// of whose points coincide is left out.
std::vector<BezierPatch> bezier_pieces(const SplineSurface& surface);

/// Where the parameter points to, by de Boor's algorithm on the knots; shares no code with the
/// pieces, as an oracle for them and their bake. `t` (u, v) is taken into the range used.
Point point_at(const SplineCurve& curve, double t);
Point point_at(const SplineSurface& surface, double u, double v);

/// The same for a piece, from its local parameter (0 to 1), by de Casteljau's.
Point point_at(const BezierCurve& piece, double local_t);
Point point_at(const BezierPatch& patch, double local_u, double local_v);

}  // namespace firmtouch::tools
