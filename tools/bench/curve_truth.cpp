#include "bench/curve_truth.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/curve_cases.hpp"
#include "curve/make_hand_walk.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {
namespace {

constexpr uint32_t kCurves = 10;
constexpr double kPromise = 4e-7;  // of max(diagonal, distance)
constexpr double kArcLoss = 3e-7;  // of the weight: arc positions are float32

struct Place {
  double x, y, z;
};
Place place(const math::Vec3& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

// The least cost of all segments, each at its own closest point, as the published problem has it.
double min_cost(const curve::View& view, const math::Vec3& at, double weight_m, double arc) {
  const Place p = place(at);
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < view.segment_count(); ++i) {
    const Place a = place(view.sample(i)), b = place(view.sample(i + 1));
    const double ex = b.x - a.x, ey = b.y - a.y, ez = b.z - a.z;
    const double along = (p.x - a.x) * ex + (p.y - a.y) * ey + (p.z - a.z) * ez;
    const double t = std::clamp(along / (ex * ex + ey * ey + ez * ez), 0.0, 1.0);
    const double dx = a.x + t * ex - p.x, dy = a.y + t * ey - p.y, dz = a.z + t * ez - p.z;
    const double from = double{view.arcs()[i]}, to = double{view.arcs()[i + 1]};
    double change = std::abs(from * (1 - t) + to * t - arc);
    if (view.is_closed()) change = std::min(change, 1 - change);
    least = std::min(least, std::sqrt(dx * dx + dy * dy + dz * dz) + weight_m * change);
  }
  return least;
}

struct Wrong {
  uint64_t closest = 0, penalised = 0;
};

void compare(const CurveCase& curve, const std::vector<math::Vec3>& points, Wrong& wrong) {
  const double diagonal = double{curve.view.head().diagonal_m};
  tools::Random random(3);
  curve::Hint hint, held;
  for (const math::Vec3& p : points) {
    const float reported = closest_point(curve.view, p, query::kUnlimited, hint).distance_m;
    const double truth = min_cost(curve.view, p, 0, 0);
    if (!(std::abs(double{reported} - truth) <= kPromise * std::max(diagonal, truth)))
      ++wrong.closest;
    const double weight_m = diagonal * std::pow(10.0, random.between(-2, 1));
    const auto arc = static_cast<float>(random.uniform());
    const curve::ArcPenalty penalty{static_cast<float>(weight_m), arc, true};
    const float cost_m = guided_point(curve.view, p, penalty, query::kUnlimited, held).cost_m;
    const double least = min_cost(curve.view, p, double{penalty.weight_m}, double{arc});
    const double slack = kPromise * std::max(diagonal, least) + kArcLoss * double{penalty.weight_m};
    if (!(std::abs(double{cost_m} - least) <= slack)) ++wrong.penalised;
  }
}

// Out along x, round a wide turn, and back beside itself at a 500th of its size.
std::vector<math::Vec3> hairpin() {
  std::vector<math::Vec3> points;
  for (int i = 0; i <= 400; ++i) points.push_back({static_cast<float>(i) / 400.0f, 0.0f, 0.0f});
  points.push_back({1.15f, 0.001f, 0.1f});
  for (int i = 400; i >= 0; --i) points.push_back({static_cast<float>(i) / 400.0f, 0.002f, 0.0f});
  return points;
}

// A hand is led along the way out and wanders beyond the middle between it and the way back.
uint32_t jumps_of(const CurveCase& track, double weight, uint32_t& backwards) {
  const curve::Hold hold{static_cast<float>(weight * double{track.view.head().diagonal_m}), 1e9f};
  curve::Following following;
  uint32_t jumps = 0;
  for (int k = 0; k <= 5000; ++k) {
    const double x = 0.05 + 0.9 * k / 5000, aside = 0.00075 * (1 - std::cos((x - 0.05) * 60));
    const math::Vec3 p{static_cast<float>(x), static_cast<float>(aside), 0.0f};
    const float change = follow(track.view, p, hold, query::kUnlimited, following).change_of_arc;
    if (std::abs(change) > 0.05f) ++jumps;
    if (change < 0) ++backwards;
  }
  return jumps;
}

}  // namespace

void run_curve_truth(const Options& options, Report& report) {
  report.heading("against brute force in double: ten curves, uneven, passing near themselves");
  const uint32_t queries = options.is_long ? 10000 : 1000;  // of each kind, a curve
  Wrong wrong;
  for (uint32_t i = 0; i < kCurves; ++i) {
    report.stage("brute force, curve " + std::to_string(i + 1) + " of 10");
    const CurveCase curve = bake_case(make_track(300 + 150 * i, i + 3), "uneven");
    std::vector<math::Vec3> points = random_points(curve, queries / 2);
    const auto walk = tools::make_hand_walk(curve.samples_m, i, queries - queries / 2);
    points.insert(points.end(), walk.begin(), walk.end());
    compare(curve, points, wrong);
  }
  const std::string queries_text = std::to_string(kCurves * queries) + " queries";
  report.bar("wrong closest points", queries_text, static_cast<double>(wrong.closest), "", 0);
  report.bar("wrong penalised points", queries_text, static_cast<double>(wrong.penalised), "", 0);
  report.heading("jumps where a track passes itself: 5,001 ticks of a hand that wanders across");
  const CurveCase track = bake_case(hairpin(), "hairpin");
  for (const double weight : {0.01, 0.1, 1.0, 10.0}) {
    uint32_t backwards = 0;
    const uint32_t jumps = jumps_of(track, weight, backwards);
    report.bar("jumps, weight of so many sizes", number_text(weight), jumps, "", 0);
    report.bar("ticks that go back", number_text(weight), backwards, "", 0);
  }
  uint32_t backwards = 0;
  report.figure("jumps without a penalty", "0", jumps_of(track, 0, backwards), "");
}

}  // namespace firmtouch::bench
