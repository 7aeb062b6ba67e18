#include "bench/all_benches.hpp"
#include "bench/field_subjects.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/timing.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr double kInteriorGoal = 0.25;
constexpr uint32_t kBarCells = 135;

void bar(const Subject& subject, const Peer& peer, Report& report) {
  const std::string what = "interior field at " + std::to_string(kBarCells) + " cells";
  report.stage(subject.name + ", " + what);
  const std::vector<tools::Point> inside = centres_of(field_of(subject, kBarCells), true);
  const double count = static_cast<double>(inside.size());
  report.figure("voxels whose centre is inside", subject.name, count, "");
  // Voxelizing, filling and the voxels on the surface are ours alone; they are counted to ours.
  std::vector<Contender> contenders{[&] {
    const tools::DistanceField distance_field = field_of(subject, kBarCells);
    return (distance_field.voxelize_s + distance_field.distance_s) * 1e6 / count;
  }};
  const TemporaryFolder folder;
  if (peer.is_present()) {
    std::vector<math::Vec3> points;
    for (const tools::Point& p : inside) points.push_back(tools::to_vec3(p));
    contenders.push_back(peer.contender(
        "closest", folder.write(subject.name + ".obj", tools::to_obj(*subject.surface)),
        folder.write("points.csv", tools::to_csv(points))));
  }
  const std::vector<double> us = medians_us(contenders);
  report.figure(what + ", one thread, sides included", subject.name, us[0] * count * 1e-6, "s");
  if (!peer.is_present())
    return report.absent(what + " against the peer", subject.name, kPeerAbsent);
  report.figure("the peer, the voxels inside alone", subject.name, us[1] * count * 1e-6, "s");
  report.bar(what + " against the peer", subject.name, us[0] / us[1], "x", kInteriorGoal);
}

}  // namespace

// The interior distance field at 135 cells along the longest axis, raced against a peer.
void run_field(const Options& options, Report& report) {
  const Peer peer(options.peer);
  for (const Subject& subject : field_subjects(options)) {
    report.heading("interior distance field: " + subject.name);
    bar(subject, peer, report);
  }
}

}  // namespace firmtouch::bench
