#include <cstdio>

#include "bench/all_benches.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/timing.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {
namespace {

// The goal is for this machine's own instruction set (the preset host-native).
constexpr double kFirstGoal = 1.5;
constexpr size_t kSegments = 10000;
struct Segment {
  math::Vec3 a_m, b_m;
};

// Ends on two different sides of a box twice the model's: the set-up of Platis & Theoharis 2003.
std::vector<Segment> across(const Model& model) {
  const mesh::Head& head = model.view.head();
  tools::Random random(5);
  const auto on_side = [&](uint32_t side) {
    double at[3];
    for (double& x : at) x = random.between(-1, 1);
    at[side / 2] = side % 2 == 0 ? -1 : 1;
    float p[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const double low = static_cast<double>(head.low_m[k]),
                   high = static_cast<double>(head.high_m[k]);
      p[k] = static_cast<float>((low + high) / 2 + at[k] * (high - low));
    }
    return math::Vec3{p[0], p[1], p[2]};
  };
  std::vector<Segment> segments;
  for (size_t i = 0; i < kSegments; ++i) {
    const uint32_t from = random.below(6);
    const uint32_t to = (from + 1 + random.below(5)) % 6;
    segments.push_back({on_side(from), on_side(to)});
  }
  return segments;
}

std::string csv_of(const std::vector<Segment>& segments) {
  std::string text = "ax,ay,az,bx,by,bz\n";
  char line[160];
  for (const Segment& s : segments) {
    std::snprintf(line, sizeof line, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
                  static_cast<double>(s.a_m.x), static_cast<double>(s.a_m.y),
                  static_cast<double>(s.a_m.z), static_cast<double>(s.b_m.x),
                  static_cast<double>(s.b_m.y), static_cast<double>(s.b_m.z));
    text += line;
  }
  return text;
}

using Answer = double (*)(const simd::WideMesh& mesh, const Segment& segment);

double first_of(const simd::WideMesh& mesh, const Segment& s) {
  return static_cast<double>(mesh.cast_segment(s.a_m, s.b_m, query::kUnlimited).t);
}
double any_of(const simd::WideMesh& mesh, const Segment& s) {
  return static_cast<double>(mesh.any_crossing(s.a_m, s.b_m, query::kUnlimited).t);
}
double all_of(const simd::WideMesh& mesh, const Segment& s) {
  mesh::SurfaceCrossing room[256];
  return mesh.all_crossings(s.a_m, s.b_m, query::kUnlimited, {room}).found;
}

Contender ours(const simd::WideMesh& mesh, const std::vector<Segment>& segments, Answer answer) {
  const auto pass = [&mesh, &segments, answer] {
    double sum = 0;
    for (const Segment& s : segments) sum += answer(mesh, s);
    return sum;
  };
  return median_of_passes(timed(segments.size(), pass));
}

void count(const Model& model, const std::vector<Segment>& segments, Report& report) {
  double steps = 0, hits = 0, crossings = 0;
  for (const Segment& s : segments) {
    const mesh::Hit hit = model.wide.cast_segment(s.a_m, s.b_m, query::kUnlimited);
    steps += hit.steps;
    hits += hit.hit ? 1 : 0;
    crossings += all_of(model.wide, s);
  }
  report.figure("segments that hit", model.name, hits, "of 10000");
  report.figure("crossings in all", model.name, crossings, "");
  report.figure("first hit, mean steps", model.name, steps / static_cast<double>(kSegments),
                "steps");
}

}  // namespace

void run_segment(const Options& options, Report& report) {
  const Peer peer(options.peer);
  for (const Model& model : load_models(options)) {
    report.heading("segments: " + model.name);
    report.stage("segments, " + model.name);
    const std::vector<Segment> segments = across(model);
    const TemporaryFolder folder;
    const Model desktop = baked_for_desktop(model);
    std::vector<Contender> contenders{ours(desktop.wide, segments, first_of)};
    for (const Answer answer : {first_of, any_of, all_of})
      contenders.push_back(ours(model.wide, segments, answer));
    if (peer.is_present()) {
      contenders.push_back(peer.contender("segment", file_for_peer(model, folder),
                                          folder.write("segments.csv", csv_of(segments))));
    }
    const std::vector<double> us = medians_us(contenders);
    count(model, segments, report);
    report.figure("first hit, --desktop", model.name, us[0], "us");
    report.figure("first hit", model.name, us[1], "us");
    report.figure("any hit", model.name, us[2], "us");
    report.figure("all hits", model.name, us[3], "us");
    if (!peer.is_present()) {
      report.absent("first hit against the peer", model.name, kPeerAbsent);
      continue;
    }
    report.figure("first hit, the peer", model.name, us[4], "us");
    report.bar("first hit, --desktop, against the peer", model.name, us[0] / us[4], "x",
               kFirstGoal);
    report.bar("first hit against the peer", model.name, us[1] / us[4], "x", kFirstGoal);
  }
}

}  // namespace firmtouch::bench
