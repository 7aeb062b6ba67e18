#include <algorithm>
#include <cstddef>

#include "spline/homogeneous.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {
namespace {

// The basis functions that are not zero at `t`, by the recurrence of Cox and de Boor, degree + 1 of
// them; `first` is the control point of the first.
std::vector<double> basis(int degree, const std::vector<double>& knots, double t, size_t& first) {
  const auto p = static_cast<size_t>(degree);
  size_t k = p;
  while (k + p + 2 < knots.size() && (t >= knots[k + 1] || !(knots[k] < knots[k + 1]))) ++k;
  while (k > p && !(knots[k] < knots[k + 1])) --k;
  first = k - p;
  std::vector<double> values(p + 1, 0.0);
  values[0] = 1;
  for (size_t r = 1; r <= p; ++r) {
    double carried = 0;
    for (size_t i = 0; i < r; ++i) {
      const double high = knots[k + i + 1], low = knots[k + i + 1 - r];
      const double share = values[i] / (high - low);
      values[i] = carried + (high - t) * share;
      carried = (t - low) * share;
    }
    values[r] = carried;
  }
  return values;
}

Homogeneous sum(Homogeneous total, const Homogeneous& h, double weight) {
  return {total.x + weight * h.x, total.y + weight * h.y, total.z + weight * h.z,
          total.w + weight * h.w};
}

Point projected(const Homogeneous& h) { return {h.x / h.w, h.y / h.w, h.z / h.w}; }

Homogeneous casteljau(std::vector<Homogeneous> level, double t) {
  for (size_t r = 1; r < level.size(); ++r)
    for (size_t i = 0; i + r < level.size(); ++i)
      level[i] = between(level[i], level[i + 1], t, 0, 1);
  return level[0];
}

}  // namespace

Point point_at(const SplineCurve& curve, double t) {
  size_t first = 0;
  const std::vector<double> values =
      basis(curve.degree, curve.knots, std::clamp(t, curve.t0, curve.t1), first);
  Homogeneous total{0, 0, 0, 0};
  for (size_t i = 0; i < values.size(); ++i)
    total = sum(total, homogeneous(curve.points[first + i], true), values[i]);
  return projected(total);
}

Point point_at(const SplineSurface& surface, double u, double v) {
  size_t first_u = 0, first_v = 0;
  const std::vector<double> across =
      basis(surface.degree_u, surface.knots_u, std::clamp(u, surface.u0, surface.u1), first_u);
  const std::vector<double> along =
      basis(surface.degree_v, surface.knots_v, std::clamp(v, surface.v0, surface.v1), first_v);
  Homogeneous total{0, 0, 0, 0};
  for (size_t j = 0; j < along.size(); ++j) {
    const ControlPoint* row = &surface.points[(first_v + j) * surface.count_u + first_u];
    for (size_t i = 0; i < across.size(); ++i)
      total = sum(total, homogeneous(row[i], true), across[i] * along[j]);
  }
  return projected(total);
}

Point point_at(const BezierCurve& piece, double local_t) {
  std::vector<Homogeneous> points;
  for (const ControlPoint& p : piece.points) points.push_back(homogeneous(p, true));
  return projected(casteljau(std::move(points), local_t));
}

Point point_at(const BezierPatch& patch, double local_u, double local_v) {
  const auto wide = static_cast<size_t>(patch.degree_u) + 1;
  std::vector<Homogeneous> column;
  for (size_t j = 0; j * wide < patch.points.size(); ++j) {
    std::vector<Homogeneous> row;
    for (size_t i = 0; i < wide; ++i) row.push_back(homogeneous(patch.points[j * wide + i], true));
    column.push_back(casteljau(std::move(row), local_u));
  }
  return projected(casteljau(std::move(column), local_v));
}

}  // namespace firmtouch::tools
