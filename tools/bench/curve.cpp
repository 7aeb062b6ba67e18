#include <cmath>
#include <functional>

#include "bake/curve/curve_runs.hpp"
#include "bake/curve/curve_tree.hpp"
#include "bench/all_benches.hpp"
#include "bench/curve_cases.hpp"
#include "bench/curve_drag.hpp"
#include "bench/curve_truth.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "curve/make_hand_walk.hpp"
#include "curve/read_curve_csv.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr uint32_t kQueries = 20000;
constexpr uint32_t kPublishedSamples = 2000;
constexpr uint32_t kLongSamples = 2000000;
constexpr double kPublished_us = 200;  // Morris 2006: 2,000 points, N = 100, a 1 GHz Pentium 4
constexpr double kMaxBytes = 24;       // a sample
constexpr double kBuildGoal = 3;       // of the peer's time
constexpr double kWrongApart = 4e-7;   // of the diagonal

using Query = std::function<double(math::Vec3)>;

Contender ours(const std::vector<math::Vec3>& points, const std::function<Query()>& fresh,
               Clock clock) {
  return timed(
      points.size(),
      [&points, fresh] {
        double sum = 0;
        const Query query = fresh();
        for (const math::Vec3& p : points) sum += query(p);
        return sum;
      },
      clock);
}

std::function<Query()> exact(const curve::View& view, bool is_warm) {
  return [&view, is_warm]() -> Query {
    return [&view, is_warm, hint = query::Hint{}](math::Vec3 p) mutable {
      if (!is_warm) hint = query::Hint{};
      return static_cast<double>(closest_point(view, p, query::kUnlimited, hint).distance_m);
    };
  };
}

// Each from the arc position of the one before.
std::function<Query()> guided(const curve::View& view, float weight_m) {
  return [&view, weight_m]() -> Query {
    return [&view, weight_m, following = curve::Following{}](math::Vec3 p) mutable {
      const curve::Hold hold{weight_m, 1e9f};
      return static_cast<double>(
          follow(view, p, hold, query::kUnlimited, following).constraint.cost_m);
    };
  };
}

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

struct Race {
  const char* what;
  std::vector<math::Vec3> points;
  bool is_warm;
  double goal;  // 0: none
};

void run_race(const Race& race, const CurveCase& curve, const Peer& peer, Report& report) {
  report.stage(std::string(race.what) + ", " + curve.name);
  const TemporaryFolder folder;
  std::vector<Contender> contenders{
      ours(race.points, exact(curve.view, race.is_warm), Clock::kWall)};
  if (peer.is_present())
    contenders.push_back(peer.contender("polyline",
                                        folder.write("curve.csv", tools::to_csv(curve.samples_m)),
                                        folder.write("points.csv", tools::to_csv(race.points))));
  const std::vector<double> us = medians_us(contenders);
  report.figure(race.what, curve.name, us[0], "us");
  const std::string against = std::string(race.what) + " against the peer";
  if (!peer.is_present()) return report.absent(against, curve.name, kPeerAbsent);
  report.figure(std::string(race.what) + ", the peer", curve.name, us[1], "us");
  if (race.goal > 0)
    report.bar(against, curve.name, us[0] / us[1], "x", race.goal);
  else
    report.figure(against, curve.name, us[0] / us[1], "x");
}

// Of both trees, reading and proving apart.
void run_build(const CurveCase& curve, const Peer& peer, Report& report) {
  report.stage("tree build, " + curve.name);
  std::vector<curve::Sample> samples(curve.view.samples().data(),
                                     curve.view.samples().data() + curve.view.samples().size());
  const TemporaryFolder folder;
  std::vector<Contender> contenders{timed(1, [&] {
    const size_t places = tools::build_curve_tree(samples).size();
    return static_cast<double>(places +
                               tools::build_curve_runs(samples, curve.view.head()).boxes.size());
  })};
  if (peer.is_present()) {
    const std::string file = folder.write("curve.csv", tools::to_csv(curve.samples_m));
    const std::string one = folder.write("one.csv", tools::to_csv({curve.samples_m[0]}));
    contenders.push_back([peer, file, one] { return peer.build_us("polyline", file, one); });
  }
  const std::vector<double> us = medians_us(contenders);
  report.figure("trees built", curve.name, us[0] * 1e-6, "s");
  const char* const against = "trees built against the peer's";
  if (!peer.is_present()) return report.absent(against, curve.name, kPeerAbsent);
  report.figure("trees built, the peer", curve.name, us[1] * 1e-6, "s");
  report.bar(against, curve.name, us[0] / us[1], "x", kBuildGoal);
}

void run_case(const CurveCase& curve, const Peer& peer, Report& report) {
  const bool is_small = curve.samples_m.size() <= kPublishedSamples;
  const bool is_large = curve.samples_m.size() >= 2000000;
  const auto walk = tools::make_hand_walk(curve.samples_m, 1, kQueries);
  report.heading("exact closest points: " + curve.name);
  report.figure("baked and proven", curve.name, curve.bake_s, "s");
  report.bar("bytes a sample that a tick reads", curve.name,
             static_cast<double>(curve.report.tick_bytes) / curve.report.samples, "bytes",
             kMaxBytes);
  run_race({"hand led along, warm", walk, true,
            is_small   ? 0.5
            : is_large ? 0.05
                       : 0},
           curve, peer, report);
  run_race({"random points, cold", random_points(curve, kQueries), false, is_large ? 0.4 : 0},
           curve, peer, report);
  if (!is_small) run_build(curve, peer, report);
  const float size_m = curve.view.head().diagonal_m;
  const std::vector<double> us =
      medians_us({ours(walk, guided(curve.view, size_m), Clock::kProcessor)});
  report.figure("hand led along, penalised by its size", curve.name, us[0], "us");
}

std::string text(double value) { return number_text(value); }

// Figures 4 and 5 of Morris 2006, section 2.3.
void run_published(const Options& options, Report& report) {
  report.heading("the published constraint: time against samples and N, penalty 1 m");
  std::vector<uint32_t> sizes{kPublishedSamples, 20000, 200000};
  if (options.is_long) sizes.push_back(kLongSamples);
  std::vector<std::vector<std::string>> rows;
  for (const uint32_t samples : sizes) {
    report.stage("figure 4, " + std::to_string(samples) + " samples");
    const CurveCase curve = bake_case(make_track(samples, 0), std::to_string(samples) + " samples");
    const auto walk = tools::make_hand_walk(curve.samples_m, 1, kQueries / 4);
    const std::vector<double> us =
        medians_us({ours(walk, nearest(curve.view, 10), Clock::kProcessor),
                    ours(walk, nearest(curve.view, 100), Clock::kProcessor),
                    ours(walk, guided(curve.view, 1.0f), Clock::kProcessor)});
    rows.push_back({std::to_string(samples), text(us[0]), text(us[1]), text(us[2])});
    if (samples == kPublishedSamples)
      report.figure("2,000 samples, N = 100, beside the 0.2 ms published", curve.name, us[1], "us",
                    text(kPublished_us / us[1]) + " x faster, on another machine");
  }
  report.table({"samples", "N = 10, us", "N = 100, us", "exact, warm, us"}, rows);
  const CurveCase curve = bake_case(make_track(kPublishedSamples, 0), "2000 samples");
  const CurveCase uneven = bake_case(make_track(kPublishedSamples, 6), "2000 samples, uneven");
  const auto walk = tools::make_hand_walk(curve.samples_m, 1, kQueries / 4);
  const auto astray = tools::make_hand_walk(uneven.samples_m, 2, kQueries / 4);
  rows.clear();
  for (const uint32_t count : {1u, 2u, 5u, 10u, 20u, 50u, 100u}) {
    report.stage("figure 5, N = " + std::to_string(count));
    const std::vector<double> us =
        medians_us({ours(walk, nearest(curve.view, count), Clock::kProcessor)});
    size_t wrong = 0;
    for (const math::Vec3& p : astray) {
      query::Hint hint;
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

}  // namespace

void run_curve(const Options& options, Report& report) {
  const Peer peer(options.peer);
  for (const std::string& path : options.models) {
    const tools::CurvePoints points = tools::read_curve_csv(path, 1.0);
    if (!points.problem.empty()) throw Problem(points.problem);
    run_case(bake_case(points.samples_m, path), peer, report);
  }
  if (!options.models.empty()) return;
  run_case(bake_case(make_track(kPublishedSamples, 0), "2,000 samples"), peer, report);
  run_case(bake_case(make_track(kPublishedSamples, 6), "2,000 samples, uneven"), peer, report);
  const uint32_t many = options.is_long ? kLongSamples : 200000;
  run_case(bake_case(make_track(many, 0), std::to_string(many) + " samples"), peer, report);
  run_curve_truth(options, report);
  run_published(options, report);
  run_force_steps(report);
  run_drag(report);
}

}  // namespace firmtouch::bench
