#include <cmath>

#include "footpoint/critical_grid.hpp"
#include "lab/picture.hpp"
#include "lab/pictures.hpp"
#include "spline/sample_splines.hpp"

namespace firmtouch::lab {
namespace {

using tools::CriticalGrid;
using tools::Footpoints;
using tools::Point;

constexpr int kSamples = 1500;
constexpr double kReach = 0.75;  // of the extent: half a side of the picture
constexpr char kEvolute[] = "stroke=\"#999\" stroke-width=\"1.8\"";
constexpr char kCritical[] = "stroke=\"#283\" stroke-width=\"2.2\"";
constexpr char kCell[] = "stroke=\"#36c\" stroke-width=\"0.5\"";
constexpr char kFocal[] = "fill=\"#c33\" fill-opacity=\"0.7\"";
constexpr char kOtherFocal[] = "fill=\"#36c\" fill-opacity=\"0.7\"";

/// A planar curve's point, unit normal and radius of curvature (negative: the centre lies to the
/// right).
struct Osculation {
  Point at, normal;
  double radius = 0;
};

Osculation osculation(const tools::SplineCurve& curve, double t) {
  const double h = 1e-4 * (curve.t1 - curve.t0);
  const double middle = std::fmin(std::fmax(t, curve.t0 + h), curve.t1 - h);
  const Point a = point_at(curve, middle - h), b = point_at(curve, middle),
              c = point_at(curve, middle + h);
  const Point first = (c - a) * (0.5 / h), second = (c - b * 2 + a) * (1 / (h * h));
  const double speed = length(first);
  const double turn = first.x * second.y - first.y * second.x;
  return {b, Point{-first.y, first.x, 0} * (1 / speed), speed * speed * speed / turn};
}

// The evolute in stretches that lie within `low` and `high`; where curvature changes its sign it
// goes to infinity. `lifted`: over the parameter.
std::vector<std::vector<Point>> evolute(const tools::SplineCurve& curve, Point low, Point high,
                                        bool lifted) {
  std::vector<std::vector<Point>> stretches(1);
  for (int k = 0; k <= kSamples; ++k) {
    const double share = static_cast<double>(k) / kSamples;
    const Osculation o = osculation(curve, curve.t0 + share * (curve.t1 - curve.t0));
    Point centre = o.at + o.normal * o.radius;
    const bool is_in =
        centre.x >= low.x && centre.x <= high.x && centre.y >= low.y && centre.y <= high.y;
    centre.z = lifted ? share : 0;
    if (is_in)
      stretches.back().push_back(centre);
    else if (!stretches.back().empty())
      stretches.emplace_back();
  }
  return stretches;
}

std::vector<Point> samples_of(const tools::SplineCurve& curve, bool lifted) {
  std::vector<Point> points;
  for (int k = 0; k <= kSamples; ++k) {
    const double share = static_cast<double>(k) / kSamples;
    points.push_back(point_at(curve, curve.t0 + share * (curve.t1 - curve.t0)));
    if (lifted) points.back().z = share;
  }
  return points;
}

// Figure 5: (a) curve and evolute; (b) the zero set over the parameter with its critical curve,
// whose projection is the evolute; (d) the cells of the plane that list critical points.
void draw_curve(const Options& options, Report& report) {
  const tools::SplineCurve curve = tools::winding_curve(4, 10, true, false);
  const Footpoints feet(bezier_pieces(curve), {});
  const double reach = kReach * feet.extent_m();
  const Point middle = (feet.low_m() + feet.high_m()) * 0.5;
  const Point low = middle - Point{reach, reach, 0}, high = middle + Point{reach, reach, 0};
  Picture plane(low, high, false);
  for (const auto& stretch : evolute(curve, low, high, false)) plane.line(stretch, kEvolute);
  plane.line(samples_of(curve, false), kShape);
  write_picture(options, "figure-5a", plane, report);

  Picture space(low, high + Point{0, 0, 1}, true);
  for (int k = 0; k <= 150; ++k) {
    const double share = k / 150.0;
    const Osculation o = osculation(curve, curve.t0 + share * (curve.t1 - curve.t0));
    // The curve's normal at this parameter, as far as it lies in the square.
    double begin = -1e300, end = 1e300;
    const auto clip = [&](double from, double least, double most, double slope) {
      if (!(std::fabs(slope) > 1e-12)) return;
      const double a = (least - from) / slope, b = (most - from) / slope;
      begin = std::fmax(begin, std::fmin(a, b)), end = std::fmin(end, std::fmax(a, b));
    };
    clip(o.at.x, low.x, high.x, o.normal.x), clip(o.at.y, low.y, high.y, o.normal.y);
    Point a = o.at + o.normal * begin, b = o.at + o.normal * end;
    a.z = b.z = share;
    space.line({a, b}, kZero);
  }
  for (const auto& stretch : evolute(curve, low, high, true)) space.line(stretch, kCritical);
  space.line(samples_of(curve, true), kShape);
  write_picture(options, "figure-5b", space, report);

  const CriticalGrid grid(feet, 5, kReach - 0.5);
  Picture cells(low, high, false);
  for (size_t cell = 0; cell < grid.cells(); ++cell) {
    if (grid.pieces_in(cell).empty()) continue;
    Point from, to;
    grid.box_of(cell, from, to);
    from.z = to.z = 0;
    cells.box(from, to, kCell);
  }
  for (const auto& stretch : evolute(curve, low, high, false)) cells.line(stretch, kEvolute);
  cells.line(samples_of(curve, false), kShape);
  write_picture(options, "figure-5d", cells, report);
}

// The centres of the two principal curvatures of a surface at (u, v); false where one is flat.
bool focal_points(const tools::SplineSurface& s, double u, double v, Point& one, Point& other) {
  const double h = 1e-3;
  const auto at = [&](double du, double dv) { return point_at(s, u + du * h, v + dv * h); };
  const Point p = at(0, 0), pu = (at(1, 0) - at(-1, 0)) * (0.5 / h),
              pv = (at(0, 1) - at(0, -1)) * (0.5 / h);
  const Point puu = (at(1, 0) - p * 2 + at(-1, 0)) * (1 / (h * h)),
              pvv = (at(0, 1) - p * 2 + at(0, -1)) * (1 / (h * h)),
              puv = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) * (0.25 / (h * h));
  Point n = cross(pu, pv);
  n = n * (1 / length(n));
  const double E = dot(pu, pu), F = dot(pu, pv), G = dot(pv, pv);
  const double L = dot(puu, n), M = dot(puv, n), N = dot(pvv, n);
  const double area2 = E * G - F * F;
  const double mean = 0.5 * (E * N - 2 * F * M + G * L) / area2;
  const double gauss = (L * N - M * M) / area2;
  const double root = std::sqrt(std::fmax(0, mean * mean - gauss));
  if (!(std::fabs(mean + root) > 1e-9) || !(std::fabs(mean - root) > 1e-9)) return false;
  one = p + n * (1 / (mean + root)), other = p + n * (1 / (mean - root));
  return true;
}

bool is_between(Point p, Point low, Point high) {
  return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
         p.z <= high.z;
}

// Figure 6: (a) a surface and its critical points, both focal sheets; (b) those along one
// iso-curve, with the cells that list them.
void draw_surface(const Options& options, Report& report) {
  const tools::SplineSurface surface = tools::hilly_surface(1, 7, 0.15, false);
  const Footpoints feet({}, bezier_pieces(surface));
  const double extent = feet.extent_m();
  const Point middle = (feet.low_m() + feet.high_m()) * 0.5;
  const Point reach{0.6 * extent, 0.6 * extent, 0.6 * extent};
  const Point low = middle - reach, high = middle + reach;
  Picture all(low, high, true), along(low, high, true);
  draw_net(all, surface, 12);
  draw_net(along, surface, 12);
  const CriticalGrid grid(feet, 5, 0.1);
  constexpr int kEach = 60;
  for (int i = 1; i < kEach; ++i) {
    for (int j = 1; j < kEach; ++j) {
      const double u = surface.u0 + (surface.u1 - surface.u0) * i / kEach,
                   v = surface.v0 + (surface.v1 - surface.v0) * j / kEach;
      Point focal[2];
      if (!focal_points(surface, u, v, focal[0], focal[1])) continue;
      for (int k = 0; k < 2; ++k) {
        if (!is_between(focal[k], low, high)) continue;
        const char* const style = k == 0 ? kFocal : kOtherFocal;
        all.dot(focal[k], 1.2, style);
        if (i != kEach / 2) continue;
        size_t cell = 0;
        Point from, to;
        along.dot(focal[k], 2.2, style);
        if (!grid.cell_of(focal[k], cell)) continue;
        grid.box_of(cell, from, to);
        along.box(from, to, grid.pieces_in(cell).empty() ? kZero : kCell);
      }
    }
  }
  write_picture(options, "figure-6a", all, report);
  write_picture(options, "figure-6b", along, report);
}

}  // namespace

void draw_critical_figures(const Options& options, Report& report) {
  report.heading("splines, figures 5 and 6: critical points, drawn into " + options.figures);
  draw_curve(options, report);
  draw_surface(options, report);
}

}  // namespace firmtouch::lab
