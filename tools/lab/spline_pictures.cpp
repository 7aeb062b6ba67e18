#include "lab/pictures.hpp"

#include <cmath>

#include "bench/problem.hpp"
#include "footpoint/tracker.hpp"
#include "lab/picture.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"

namespace firmtouch::lab {
namespace {

using tools::Footpoints;
using tools::Point;

constexpr size_t kPositions = 200;

std::vector<Point> samples_of(const tools::SplineCurve& c, size_t count) {
  std::vector<Point> points;
  for (size_t k = 0; k <= count; ++k)
    points.push_back(
        point_at(c, c.t0 + (c.t1 - c.t0) * static_cast<double>(k) / static_cast<double>(count)));
  return points;
}

// The nearest points along a path, by marching over the critical cells.
std::vector<Point> nearest(const Footpoints& feet, int levels, const std::vector<Point>& path) {
  const tools::CriticalGrid grid(feet, levels, 0.25);
  tools::Tracker tracker(feet, grid, {});
  std::vector<Point> found;
  for (size_t k = 0; k < path.size(); ++k) {
    if (k == 0)
      tracker.start(path[0]);
    else
      tracker.move(path[k]);
    found.push_back(tracker.nearest_m());
  }
  return found;
}

void draw_joins(Picture& picture, const std::vector<Point>& path, const std::vector<Point>& found) {
  picture.line(path, kPath);
  for (size_t k = 0; k < path.size(); ++k) picture.line({path[k], found[k]}, kJoin);
}

// Figures 7, 8 and 9: (a) the plane; (b) the zero set over x, y and the parameter: at each
// parameter the curve's normal.
void draw_curve(const Options& options, const std::string& name, uint64_t seed, size_t points,
                bool with_zero_set, Report& report) {
  const tools::SplineCurve curve = tools::winding_curve(seed, points, true, true);
  const Footpoints feet(bezier_pieces(curve), {});
  const std::vector<Point> path = tools::path_about(
      tools::wandering_path(seed + 20, kPositions, 0.01, 0, 0), feet.low_m(), feet.high_m());
  const std::vector<Point> found = nearest(feet, 5, path);
  const double reach = 0.75 * feet.extent_m();
  const Point middle = (feet.low_m() + feet.high_m()) * 0.5;
  const Point low = middle - Point{reach, reach, 0}, high = middle + Point{reach, reach, 0};
  Picture plane(low, high, false);
  draw_joins(plane, path, found);
  plane.line(samples_of(curve, 600), kShape);
  write_picture(options, with_zero_set ? name + "a" : name, plane, report);
  if (!with_zero_set) return;
  Picture space(low, high + Point{0, 0, 1}, true);
  for (int k = 0; k <= 150; ++k) {
    const double t = k / 150.0, step = 1e-5;
    const Point at = point_at(curve, t), d = point_at(curve, t + step) - point_at(curve, t - step);
    const double size = length(d);
    if (!(size > 0)) continue;
    // The normal, as far as it lies in the square.
    double begin = -1e300, end = 1e300;
    const auto clip = [&](double from, double least, double most, double slope) {
      if (!(std::fabs(slope) > 1e-12)) return;
      const double a = (least - from) / slope, b = (most - from) / slope;
      begin = std::fmax(begin, std::fmin(a, b)), end = std::fmin(end, std::fmax(a, b));
    };
    clip(at.x, low.x, high.x, -d.y / size), clip(at.y, low.y, high.y, d.x / size);
    const Point normal{-d.y / size, d.x / size, 0};
    Point a = at + normal * begin, b = at + normal * end;
    a.z = b.z = t;
    space.line({a, b}, kZero);
  }
  for (size_t k = 0; k < path.size(); ++k) {
    bool is_complete = false;
    const tools::Footpoint first = feet.all(path[k], is_complete).front();
    space.dot({path[k].x, path[k].y, first.u}, 3, kFound);
  }
  std::vector<Point> lifted = samples_of(curve, 600);
  for (size_t k = 0; k < lifted.size(); ++k) lifted[k].z = static_cast<double>(k) / 600;
  space.line(lifted, kShape);
  write_picture(options, name + "b", space, report);
}

// Figures 10 and 11.
void draw_surfaces(const Options& options, const std::string& name,
                   const std::vector<tools::SplineSurface>& surfaces, uint64_t seed, int lines,
                   Report& report) {
  report.stage("drawing " + name);
  std::vector<tools::BezierPatch> patches;
  for (const tools::SplineSurface& s : surfaces)
    for (tools::BezierPatch& patch : bezier_pieces(s)) patches.push_back(std::move(patch));
  const Footpoints feet({}, patches);
  const double extent = feet.extent_m();
  const Point middle = (feet.low_m() + feet.high_m()) * 0.5;
  const std::vector<Point> path = tools::path_about(
      tools::wandering_path(seed, kPositions, 0.01, 0.1, 0.9), feet.low_m(), feet.high_m());
  const Point reach{0.6 * extent, 0.6 * extent, 0.3 * extent};
  Picture picture(middle - reach, middle + reach, true);
  draw_joins(picture, path, nearest(feet, 4, path));
  for (const tools::SplineSurface& s : surfaces) draw_net(picture, s, lines);
  write_picture(options, name, picture, report);
}

}  // namespace

void draw_spline_figures(const Options& options, Report& report) {
  report.heading("figures 7 to 11, drawn into " + options.figures);
  draw_curve(options, "figure-7", 2, 10, true, report);
  draw_curve(options, "figure-8", 4, 13, true, report);
  draw_curve(options, "figure-9a", 7, 18, false, report);
  draw_curve(options, "figure-9b", 9, 20, false, report);
  draw_surfaces(options, "figure-10a", {tools::hilly_surface(1, 7, 0.15, true)}, 31, 12, report);
  draw_surfaces(options, "figure-10b", {tools::hilly_surface(2, 8, 0.1, true)}, 32, 12, report);
  draw_surfaces(options, "figure-11a", {tools::hilly_surface(5, 8, 0.25, true)}, 33, 12, report);
  if (options.models.empty()) {
    draw_surfaces(options, "figure-11b",
                  {tools::hilly_surface(6, 7, 0.1, false), tools::hilly_surface(8, 7, 0.3, true)},
                  34, 12, report);
    return;
  }
  const tools::SplineModel model = tools::read_spline_file(options.models[0], 0);
  if (!model.problem.empty()) throw Problem(model.problem);
  if (!model.surfaces.empty()) draw_surfaces(options, "figure-11b", model.surfaces, 34, 4, report);
}

}  // namespace firmtouch::lab
