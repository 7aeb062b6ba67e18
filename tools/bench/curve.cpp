#include "bake/curve/curve_runs.hpp"
#include "bake/curve/curve_tree.hpp"
#include "bench/all_benches.hpp"
#include "bench/curve_cases.hpp"
#include "bench/curve_force.hpp"
#include "bench/curve_query.hpp"
#include "bench/curve_truth.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "curve/make_hand_walk.hpp"
#include "curve/read_curve_csv.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr uint32_t kQueries = 20000;
constexpr uint32_t kPublishedSamples = 2000;
constexpr uint32_t kLongSamples = 2000000;
constexpr double kMaxBytes = 24;  // a sample
constexpr double kBuildGoal = 3;  // of the peer's time

std::function<Query()> exact(const curve::View& view, bool is_warm) {
  return [&view, is_warm]() -> Query {
    return [&view, is_warm, hint = curve::Hint{}](math::Vec3 p) mutable {
      if (!is_warm) hint = curve::Hint{};
      return static_cast<double>(closest_point(view, p, query::kUnlimited, hint).distance_m);
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
  std::vector<Contender> contenders{ours(race.points, exact(curve.view, race.is_warm))};
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
  const std::vector<double> us = medians_us({ours(walk, guided(curve.view, size_m))});
  report.figure("hand led along, penalised by its size", curve.name, us[0], "us");
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
  run_force_steps(report);
}

}  // namespace firmtouch::bench
