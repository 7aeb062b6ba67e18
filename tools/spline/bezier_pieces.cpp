#include <cstddef>

#include "spline/homogeneous.hpp"
#include "spline/spline.hpp"

// A span of a B-spline as a Bezier piece: its points are values of the span's blossom, the one
// function of `degree` arguments that is affine in each, symmetric, and the curve where all are
// equal. Point i takes the piece's begin degree - i times and its end i times; this is what
// inserting both knots to full multiplicity comes to. (Ramshaw 1987; Farin 2002, chapter 8.)

namespace firmtouch::tools {
namespace {

// A row of control points, weights multiplied in, with the knots that belong to it.
struct Row {
  int degree;
  const std::vector<double>& knots;
  std::vector<Homogeneous> points;
};

struct Span {
  size_t knot;  // the span is knots[knot] to knots[knot + 1]
  double from, to;
  bool joins;  // with the span before it
};

Homogeneous blossom(const Row& row, size_t knot, const double* arguments) {
  const auto degree = static_cast<size_t>(row.degree);
  std::vector<Homogeneous> level(row.points.begin() + static_cast<ptrdiff_t>(knot - degree),
                                 row.points.begin() + static_cast<ptrdiff_t>(knot + 1));
  for (size_t r = 1; r <= degree; ++r) {
    for (size_t i = 0; i + r <= degree; ++i) {
      const double low = row.knots[knot - degree + i + r], high = row.knots[knot + i + 1];
      level[i] = between(level[i], level[i + 1], arguments[r - 1], low, high);
    }
  }
  return level[0];
}

std::vector<Homogeneous> piece_of(const Row& row, const Span& span) {
  std::vector<Homogeneous> points;
  std::vector<double> arguments(static_cast<size_t>(row.degree), span.from);
  points.push_back(blossom(row, span.knot, arguments.data()));
  for (double& argument : arguments) {
    argument = span.to;
    points.push_back(blossom(row, span.knot, arguments.data()));
  }
  return points;
}

std::vector<Span> spans_of(int degree, const std::vector<double>& knots, double from, double to) {
  std::vector<Span> spans;
  const auto first = static_cast<size_t>(degree);
  size_t multiplicity = 0;  // of the knot where the span begins
  for (size_t k = first; k + first + 1 < knots.size(); ++k) {
    multiplicity = k > 0 && knots[k - 1] < knots[k] ? 1 : multiplicity + 1;
    const double low = from > knots[k] ? from : knots[k];
    const double high = to < knots[k + 1] ? to : knots[k + 1];
    if (!(low < high)) continue;
    spans.push_back({k, low, high, !spans.empty() && multiplicity <= first});
  }
  return spans;
}

// Every span of a row, ends that meet made equal to the bit.
std::vector<std::vector<Homogeneous>> pieces_of(const Row& row, const std::vector<Span>& spans) {
  std::vector<std::vector<Homogeneous>> pieces;
  for (const Span& span : spans) {
    std::vector<Homogeneous> points = piece_of(row, span);
    if (span.joins) points.front() = pieces.back().back();
    pieces.push_back(std::move(points));
  }
  return pieces;
}

bool has_extent(const std::vector<ControlPoint>& points) {
  for (const ControlPoint& p : points) {
    const ControlPoint& first = points.front();
    if (p.x < first.x || p.x > first.x || p.y < first.y || p.y > first.y || p.z < first.z ||
        p.z > first.z)
      return true;
  }
  return false;
}

}  // namespace

bool is_rational(const std::vector<ControlPoint>& points) {
  for (const ControlPoint& p : points)
    if (p.w < points.front().w || p.w > points.front().w) return true;
  return false;
}

std::vector<BezierCurve> bezier_pieces(const SplineCurve& curve) {
  std::vector<BezierCurve> pieces;
  const bool weighs = is_rational(curve.points);
  Row row{curve.degree, curve.knots, {}};
  for (const ControlPoint& p : curve.points) row.points.push_back(homogeneous(p, weighs));
  const std::vector<Span> spans = spans_of(curve.degree, curve.knots, curve.t0, curve.t1);
  const std::vector<std::vector<Homogeneous>> rows = pieces_of(row, spans);
  for (size_t s = 0; s < spans.size(); ++s) {
    BezierCurve piece{curve.degree, {}, spans[s].from, spans[s].to, curve.piece};
    for (const Homogeneous& h : rows[s]) piece.points.push_back(control_point(h, weighs));
    if (has_extent(piece.points)) pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<BezierPatch> bezier_pieces(const SplineSurface& surface) {
  const bool weighs = is_rational(surface.points);
  const std::vector<Span> across =
      spans_of(surface.degree_u, surface.knots_u, surface.u0, surface.u1);
  const std::vector<Span> along =
      spans_of(surface.degree_v, surface.knots_v, surface.v0, surface.v1);
  // First every row of points in u, then every column of what that gives in v.
  std::vector<std::vector<std::vector<Homogeneous>>> rows;  // [j][span of u][point]
  for (size_t j = 0; j < surface.count_v; ++j) {
    Row row{surface.degree_u, surface.knots_u, {}};
    for (size_t i = 0; i < surface.count_u; ++i)
      row.points.push_back(homogeneous(surface.points[j * surface.count_u + i], weighs));
    rows.push_back(pieces_of(row, across));
  }
  const auto wide = static_cast<size_t>(surface.degree_u) + 1;
  const auto high = static_cast<size_t>(surface.degree_v) + 1;
  std::vector<BezierPatch> patches(across.size() * along.size());
  for (size_t a = 0; a < across.size(); ++a) {
    for (size_t i = 0; i < wide; ++i) {
      Row column{surface.degree_v, surface.knots_v, {}};
      for (size_t j = 0; j < surface.count_v; ++j) column.points.push_back(rows[j][a][i]);
      const std::vector<std::vector<Homogeneous>> parts = pieces_of(column, along);
      for (size_t b = 0; b < along.size(); ++b) {
        BezierPatch& patch = patches[b * across.size() + a];
        patch.points.resize(wide * high);
        for (size_t j = 0; j < high; ++j)
          patch.points[j * wide + i] = control_point(parts[b][j], weighs);
      }
    }
  }
  std::vector<BezierPatch> kept;
  for (size_t k = 0; k < patches.size(); ++k) {
    BezierPatch& patch = patches[k];
    if (!has_extent(patch.points)) continue;
    const Span &u = across[k % across.size()], &v = along[k / across.size()];
    patch.degree_u = surface.degree_u;
    patch.degree_v = surface.degree_v;
    patch.u0 = u.from, patch.u1 = u.to, patch.v0 = v.from, patch.v1 = v.to;
    patch.piece = surface.piece;
    kept.push_back(std::move(patch));
  }
  return kept;
}

}  // namespace firmtouch::tools
