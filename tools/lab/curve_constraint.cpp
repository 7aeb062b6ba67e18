#include "bench/curve_cases.hpp"
#include "bench/curve_query.hpp"
#include "curve/make_hand_walk.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

constexpr uint32_t kQueries = 5000;
constexpr uint32_t kPublishedSamples = 2000;
constexpr uint32_t kLongSamples = 2000000;
constexpr double kPublished_us = 200;  // Morris 2006: 2,000 points, N = 100, a 1 GHz Pentium 4
constexpr double kWrongApart = 4e-7;   // of the diagonal

std::function<Query()> nearest(const curve::View& view, uint32_t count) {
  return [&view, count]() -> Query {
    return [&view, count, penalty = curve::ArcPenalty{1.0f, 0.0f, false}](math::Vec3 p) mutable {
      curve::Neighbour memory[curve::kMaxNearest];
      const curve::Constraint found = nearest_constraint(
          view, p, penalty, core::Span<curve::Neighbour>(memory, count), query::kUnlimited);
      penalty.previous_arc = found.closest.arc;
      penalty.has_previous = true;
      return static_cast<double>(found.cost_m);
    };
  };
}

std::string text(double value) { return number_text(value); }

}  // namespace

// Figures 4 and 5 of Morris 2006, section 2.3.
void run_curve_constraint(const Options& options, Report& report) {
  report.heading("the published constraint: time against samples and N, penalty 1 m");
  std::vector<uint32_t> sizes{kPublishedSamples, 20000, 200000};
  if (options.is_long) sizes.push_back(kLongSamples);
  std::vector<std::vector<std::string>> rows;
  for (const uint32_t samples : sizes) {
    report.stage("figure 4, " + std::to_string(samples) + " samples");
    const CurveCase curve = bake_case(make_track(samples, 0), std::to_string(samples) + " samples");
    const auto walk = tools::make_hand_walk(curve.samples_m, 1, kQueries);
    const std::vector<double> us =
        medians_us({ours(walk, nearest(curve.view, 10)), ours(walk, nearest(curve.view, 100)),
                    ours(walk, guided(curve.view, 1.0f))});
    rows.push_back({std::to_string(samples), text(us[0]), text(us[1]), text(us[2])});
    if (samples == kPublishedSamples)
      report.figure("2,000 samples, N = 100, beside the 0.2 ms published", curve.name, us[1], "us",
                    text(kPublished_us / us[1]) + " x faster, on another machine");
  }
  report.table({"samples", "N = 10, us", "N = 100, us", "exact, warm, us"}, rows);
  const CurveCase curve = bake_case(make_track(kPublishedSamples, 0), "2000 samples");
  const CurveCase uneven = bake_case(make_track(kPublishedSamples, 6), "2000 samples, uneven");
  const auto walk = tools::make_hand_walk(curve.samples_m, 1, kQueries);
  const auto astray = tools::make_hand_walk(uneven.samples_m, 2, kQueries);
  rows.clear();
  for (const uint32_t count : {1u, 2u, 5u, 10u, 20u, 50u, 100u}) {
    report.stage("figure 5, N = " + std::to_string(count));
    const std::vector<double> us = medians_us({ours(walk, nearest(curve.view, count))});
    size_t wrong = 0;
    for (const math::Vec3& p : astray) {
      curve::Hint hint;
      curve::Neighbour memory[curve::kMaxNearest];
      const float reported =
          nearest_constraint(uneven.view, p, {}, core::Span<curve::Neighbour>(memory, count),
                             query::kUnlimited)
              .closest.distance_m;
      const float truth = closest_point(uneven.view, p, query::kUnlimited, hint).distance_m;
      if (static_cast<double>(reported - truth) >
          kWrongApart * static_cast<double>(uneven.view.head().diagonal_m))
        ++wrong;
    }
    rows.push_back({std::to_string(count), text(us[0]),
                    text(100.0 * static_cast<double>(wrong) / static_cast<double>(astray.size()))});
  }
  report.table({"N", "2,000 samples, us", "wrong on uneven samples, %"}, rows);
}

}  // namespace firmtouch::lab
