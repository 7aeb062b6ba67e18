#include "footpoint/asset_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "footpoint/curve_system.hpp"

namespace firmtouch::tools {
namespace {

// s^k for s from -1 to 1 as Bernstein coefficients of `degree` over 0 to 1.
Scalars power(int k, int degree) {
  Scalars p(0, 0), s(1, 0), one(1, 0);
  p.c = {1};
  s.c = {-1, 1};
  one.c = {1, 1};
  for (int i = 0; i < degree; ++i) p = product(p, i < k ? s : one);
  return p;
}

// A piece's control points, from the powers of s and t.
std::vector<ControlPoint> points_of(const spline::View& view, const spline::Piece& piece) {
  const size_t wide = piece.degree_u + size_t{1}, high = piece.degree_v + size_t{1};
  const size_t each = piece.is_rational != 0 ? 4 : 3;
  std::vector<Scalars> across, along;
  for (size_t k = 0; k < wide; ++k) across.push_back(power(static_cast<int>(k), piece.degree_u));
  for (size_t k = 0; k < high; ++k) along.push_back(power(static_cast<int>(k), piece.degree_v));
  std::vector<ControlPoint> points(wide * high, {0, 0, 0, piece.is_rational != 0 ? 0.0 : 1.0});
  for (size_t j = 0; j < high; ++j) {
    for (size_t i = 0; i < wide; ++i) {
      const size_t first = piece.coefficients + (j * wide + i) * each;
      const auto c = [&](size_t k) {
        return static_cast<double>(view.coefficients()[static_cast<uint32_t>(first + k)]);
      };
      for (size_t l = 0; l < high; ++l) {
        for (size_t k = 0; k < wide; ++k) {
          const double share = across[i].c[k] * along[j].c[l];
          ControlPoint& p = points[l * wide + k];
          p.x += share * c(0), p.y += share * c(1), p.z += share * c(2);
          if (each == 4) p.w += share * c(3);
        }
      }
    }
  }
  for (ControlPoint& p : points) {
    p.x = p.x / p.w + static_cast<double>(piece.origin_m[0]);
    p.y = p.y / p.w + static_cast<double>(piece.origin_m[1]);
    p.z = p.z / p.w + static_cast<double>(piece.origin_m[2]);
  }
  return points;
}

// The part of a patch from one parameter to another, of u or of v.
BezierPatch part_of(const BezierPatch& patch, bool of_v, double from, double to) {
  SplineSurface s;
  s.degree_u = patch.degree_u, s.degree_v = patch.degree_v;
  s.count_u = static_cast<size_t>(s.degree_u) + 1, s.count_v = static_cast<size_t>(s.degree_v) + 1;
  s.knots_u.assign(s.count_u, patch.u0), s.knots_u.resize(2 * s.count_u, patch.u1);
  s.knots_v.assign(s.count_v, patch.v0), s.knots_v.resize(2 * s.count_v, patch.v1);
  s.points = patch.points;
  s.piece = patch.piece;
  s.u0 = of_v ? patch.u0 : from, s.u1 = of_v ? patch.u1 : to;
  s.v0 = of_v ? from : patch.v0, s.v1 = of_v ? to : patch.v1;
  return bezier_pieces(s)[0];
}

bool is_near(const ControlPoint& p, Point at, double tolerance) {
  return length(Point{p.x, p.y, p.z} - at) <= tolerance;
}

// Parameter at which `at` lies inside an edge, from 0 to 1; NaN where it does not. An end of the
// edge is not inside it, and a pole, an edge that is one point, has no inside.
double inner_parameter(const CurveSystem& edge, Point at, double tolerance) {
  const std::vector<ControlPoint>& points = edge.piece.points;
  if (is_near(points.front(), at, tolerance) || is_near(points.back(), at, tolerance)) return NAN;
  bool beside[6] = {true, true, true, true, true, true};
  for (const ControlPoint& p : points) {
    beside[0] &= p.x > at.x + tolerance, beside[1] &= p.x < at.x - tolerance;
    beside[2] &= p.y > at.y + tolerance, beside[3] &= p.y < at.y - tolerance;
    beside[4] &= p.z > at.z + tolerance, beside[5] &= p.z < at.z - tolerance;
  }
  if (std::any_of(beside, beside + 6, [](bool b) { return b; })) return NAN;
  std::vector<Root> roots;
  bool is_zero = false;
  roots_of(edge.coefficients(at), edge.noise(at), roots, is_zero);
  for (const Root& root : roots)
    if (root.t > 1e-3 && root.t < 1 - 1e-3 && length(edge.point(root.t) - at) <= tolerance)
      return root.t;
  return NAN;
}

// The baker cuts a patch whose neighbour stays whole: patches are cut until no corner of another
// lies within an edge, so that edges meet edge by edge.
bool cut_at_corners(std::vector<BezierPatch>& patches, double tolerance) {
  std::vector<Point> corners;
  for (const BezierPatch& p : patches)
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0}) corners.push_back(point_at(p, u, v));
  std::vector<BezierPatch> cut;
  for (const BezierPatch& p : patches) {
    const size_t wide = static_cast<size_t>(p.degree_u) + 1;
    const size_t high = static_cast<size_t>(p.degree_v) + 1;
    double at = NAN;
    bool of_v = false;
    for (int side = 0; side < 4 && std::isnan(at); ++side) {
      of_v = side > 1;
      const size_t fixed = side % 2 == 0 ? 0 : (of_v ? wide : high) - 1;
      BezierCurve edge{of_v ? p.degree_v : p.degree_u, {}, 0, 1, p.piece};
      for (size_t k = 0; k < (of_v ? high : wide); ++k)
        edge.points.push_back(p.points[of_v ? k * wide + fixed : fixed * wide + k]);
      const CurveSystem system(edge);
      for (size_t k = 0; k < corners.size() && std::isnan(at); ++k)
        at = inner_parameter(system, corners[k], tolerance);
    }
    if (std::isnan(at)) {
      cut.push_back(p);
      continue;
    }
    const double low = of_v ? p.v0 : p.u0, high_end = of_v ? p.v1 : p.u1;
    const double middle = low + at * (high_end - low);
    cut.push_back(part_of(p, of_v, low, middle));
    cut.push_back(part_of(p, of_v, middle, high_end));
  }
  const bool has_cut = cut.size() != patches.size();
  patches = std::move(cut);
  return has_cut;
}

}  // namespace

void asset_pieces(const spline::View& view, std::vector<BezierCurve>& curves,
                  std::vector<BezierPatch>& patches) {
  for (uint32_t k = 0; k < view.pieces().size(); ++k) {
    const spline::Piece& piece = view.pieces()[k];
    const auto entity = static_cast<int>(piece.entity);
    const double u = static_cast<double>(piece.middle_u), du = static_cast<double>(piece.half_u);
    const double v = static_cast<double>(piece.middle_v), dv = static_cast<double>(piece.half_v);
    if (view.is_surface())
      patches.push_back({piece.degree_u, piece.degree_v, points_of(view, piece), u - du, u + du,
                         v - dv, v + dv, entity});
    else
      curves.push_back({piece.degree_u, points_of(view, piece), u - du, u + du, entity});
  }
  const double tolerance = kAssetGap * static_cast<double>(view.head().extent_m);
  // Pieces narrower than the tolerance never meet edge by edge: their inner edges are listed.
  const size_t most = 8 * patches.size();
  for (int pass = 0; pass < 16 && patches.size() < most; ++pass)
    if (!cut_at_corners(patches, tolerance)) break;
}

}  // namespace firmtouch::tools
