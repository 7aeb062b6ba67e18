#include "bench/all_benches.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/timing.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

// The goals are for this machine's own instruction set (the preset host-native).
constexpr double kWalkGoal = 0.25;
constexpr double kRandomGoal = 0.35;
constexpr uint32_t kQueries = 20000;

// All points in order; warm: each starts where the one before ended.
Contender ours(const mesh::View& view, const std::vector<math::Vec3>& points, bool is_warm) {
  return timed(points.size(), [&view, &points, is_warm] {
    double sum = 0;
    query::Hint hint;
    for (const math::Vec3& p : points) {
      if (!is_warm) hint = query::Hint{};
      sum += static_cast<double>(mesh::closest_point(view, p, query::kUnlimited, hint).distance_m);
    }
    return sum;
  });
}

struct Race {
  const char* what;
  std::vector<math::Vec3> points;
  bool is_warm;
  double goal;
};

void run_race(const Race& race, const Model& model, const Peer& peer, Report& report) {
  report.stage(std::string(race.what) + ", " + model.name);
  const TemporaryFolder folder;
  std::vector<Contender> contenders{ours(model.view, race.points, race.is_warm)};
  if (peer.is_present()) {
    contenders.push_back(peer.contender("closest", file_for_peer(model, folder),
                                        folder.write("points.csv", tools::to_csv(race.points))));
  }
  const std::vector<double> us = medians_us(contenders);
  report.figure(race.what, model.name, us[0], "us");
  const std::string against = std::string(race.what) + " against the peer";
  if (!peer.is_present()) return report.absent(against, model.name, kPeerAbsent);
  report.figure(std::string(race.what) + ", the peer", model.name, us[1], "us");
  report.bar(against, model.name, us[0] / us[1], "x", race.goal);
}

}  // namespace

void run_distance(const Options& options, Report& report) {
  const Peer peer(options.peer);
  for (const Model& model : load_models(options)) {
    report.heading("closest points: " + model.name);
    run_race({"touching path, warm", walk(model, kQueries), true, kWalkGoal}, model, peer, report);
    run_race({"random points, cold, exact", random_points(model, kQueries), false, kRandomGoal},
             model, peer, report);
  }
}

}  // namespace firmtouch::bench
