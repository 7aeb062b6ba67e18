#include "bench/all_benches.hpp"

#include <cstdio>
#include <memory>
#include <type_traits>

#include "bake/spline/spline_choice.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "footpoint/footpoints.hpp"
#include "spline/sample_splines.hpp"

namespace firmtouch::bench {
namespace {

using tools::Footpoints;
using tools::Point;

constexpr double kStep = 0.002;                               // of the extent, a move
constexpr double kCurveGoal = 1.0 / 60, kSurfaceGoal = 0.01;  // of the peer's time

// The plain numbers that a peer reads: kind, counts and degree, knots, weights, points.
std::string plain_text(std::string text, const std::vector<std::vector<double>>& knots,
                       const std::vector<tools::ControlPoint>& points) {
  char number[40];
  const auto put = [&](double x, const char* end) {
    std::snprintf(number, sizeof(number), "%.17g%s", x, end);
    text += number;
  };
  for (const std::vector<double>& of : knots) {
    text += "\n";
    for (const double x : of) put(x, " ");
  }
  text += "\n";
  for (const tools::ControlPoint& p : points) put(p.w, " ");
  for (const tools::ControlPoint& p : points) {
    text += "\n";
    put(p.x, " "), put(p.y, " "), put(p.z, "");
  }
  return text + "\n";
}

std::string plain_text(const tools::SplineCurve& c) {
  return plain_text("curve " + std::to_string(c.points.size()) + " " + std::to_string(c.degree),
                    {c.knots}, c.points);
}

std::string plain_text(const tools::SplineSurface& s) {
  return plain_text("surface " + std::to_string(s.count_u) + " " + std::to_string(s.count_v) + " " +
                        std::to_string(s.degree_u),
                    {s.knots_u, s.knots_v}, s.points);
}

std::string csv_of(const std::vector<Point>& points) {
  std::string text = "x,y,z\n";
  char row[100];
  for (const Point& p : points) {
    std::snprintf(row, sizeof(row), "%.9g,%.9g,%.9g\n", p.x, p.y, p.z);
    text += row;
  }
  return text;
}

Footpoints footpoints_of(const tools::SplineCurve& c) { return {tools::bezier_pieces(c), {}}; }
Footpoints footpoints_of(const tools::SplineSurface& s) { return {{}, tools::bezier_pieces(s)}; }

// All foot-points from scratch, in double.
template <class Spline>
Contender all_footpoints(const Spline& spline, const std::vector<Point>& path) {
  const auto feet = std::make_shared<Footpoints>(footpoints_of(spline));
  return timed(path.size(), [feet, &path] {
    double total = 0;
    for (const Point p : path) {
      bool is_complete = false;
      total += feet->all(p, is_complete).front().distance_m;
    }
    return total;
  });
}

struct BakedSpline {
  std::vector<tools::Section> sections;
  spline::View view;
};

template <class Spline>
std::unique_ptr<BakedSpline> baked_of(const Spline& spline) {
  constexpr bool kIsCurve = std::is_same_v<Spline, tools::SplineCurve>;
  tools::SplineModel model;
  if constexpr (kIsCurve)
    model.curves.push_back(spline);
  else
    model.surfaces.push_back(spline);
  tools::SplineReport reported;
  auto baked = std::make_unique<BakedSpline>();
  baked->sections = tools::bake_fast_spline(model, "spline", false, reported);
  if (!reported.problem.empty()) throw Problem(reported.problem);
  if (!tools::open_baked(baked->sections, "spline", baked->view).ok())
    throw Problem("a baked spline does not open");
  return baked;
}

// The global closest point with its certificate, led along the path; cold: each on its own.
Contender certified(const BakedSpline& baked, const std::vector<math::Vec3>& path, bool is_cold) {
  return median_of_passes(timed(path.size(), [&baked, &path, is_cold] {
    spline::Hint hint;
    double total = 0;
    for (const math::Vec3& p : path) {
      if (is_cold) hint = {};
      const spline::Closest c = closest_point(baked.view, p, query::kUnlimited, hint);
      total += static_cast<double>(c.distance_m);
    }
    return total;
  }));
}

template <class Spline>
void race(const char* what, const Spline& spline, const std::vector<Point>& path, const Peer& peer,
          Report& report) {
  constexpr bool kIsCurve = std::is_same_v<Spline, tools::SplineCurve>;
  const std::string led = "certified closest point, led along, time against the peer's global one";
  if (!peer.is_present()) return report.absent(led, what, kPeerAbsent);
  report.stage(std::string("the peer, ") + what);
  const auto baked = baked_of(spline);
  std::vector<math::Vec3> places;
  for (const Point& p : path) places.push_back(tools::to_vec3(p));
  const TemporaryFolder folder;
  const std::vector<double> us =
      medians_us({certified(*baked, places, false), certified(*baked, places, true),
                  all_footpoints(spline, path),
                  peer.contender("spline", folder.write("spline.txt", plain_text(spline)),
                                 folder.write("points.csv", csv_of(path)))});
  const auto remark = [&](double ours) {
    return number_text(ours) + " us, the peer " + number_text(us[3]) + " us, " +
           number_text(us[3] / ours) + " times as long";
  };
  report.bar(led, what, us[0] / us[3], "x", kIsCurve ? kCurveGoal : kSurfaceGoal);
  report.figure("the same", what, us[3] / us[0], "times faster", remark(us[0]));
  report.figure("each on its own", what, us[3] / us[1], "times faster", remark(us[1]));
  report.figure("all foot-points from scratch", what, us[3] / us[2], "times faster", remark(us[2]));
}

}  // namespace

void run_spline_race(const Options& options, Report& report) {
  const Peer peer(options.peer);
  report.heading("against another library's global routine");
  race("planar cubic", tools::winding_curve(1, 15, true, false),
       tools::wandering_path(1, 300, kStep, 0, 0), peer, report);
  race("planar NURBS", tools::winding_curve(2, 15, true, true),
       tools::wandering_path(2, 300, kStep, 0, 0), peer, report);
  race("space NURBS", tools::winding_curve(3, 15, false, true),
       tools::wandering_path(3, 300, kStep, -0.2, 1.2), peer, report);
  race("surface", tools::hilly_surface(1, 8, 0.15, false),
       tools::wandering_path(1, 100, kStep, -0.3, 0.5), peer, report);
  race("NURBS surface", tools::hilly_surface(2, 8, 0.15, true),
       tools::wandering_path(2, 100, kStep, -0.3, 0.5), peer, report);
}

}  // namespace firmtouch::bench
