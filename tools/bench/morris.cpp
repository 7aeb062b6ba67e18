#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "bench/all_benches.hpp"
#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "field/distance_field.hpp"
#include "field/morris_search.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"
#include "surface/read/read_surface.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::bench {
namespace {

constexpr double kInteriorGoal = 0.25;
constexpr uint32_t kBarCells = 135;

// Morris 2006, Table 1, the bunny.
struct Row {
  uint32_t cells;
  size_t voxels;
  double total_s, distance_s;
};
constexpr Row kPaper[] = {{30, 7168, 0.736, 0.683},
                          {75, 95628, 6.107, 5.282},
                          {135, 529024, 29.033, 25.258},
                          {195, 1561728, 82.341, 71.585}};

struct Subject {
  std::string name;
  std::unique_ptr<tools::Surface> surface;
  std::vector<tools::Solid> solids;  // one
  bool is_bunny = false;
};

Subject subject_of(tools::Surface surface, const std::string& name) {
  Subject subject;
  subject.name = name;
  subject.surface = std::make_unique<tools::Surface>(std::move(surface));
  subject.solids.emplace_back(*subject.surface);
  subject.is_bunny = name.find("bunny") != name.npos;
  return subject;
}

// Holes are closed, as --close-holes does.
Subject load(const std::string& path) {
  tools::Imported imported = tools::read_surface(path, 1.0);
  if (!imported.problem.empty()) throw Problem(imported.problem);
  tools::CheckOptions checks;
  checks.close_holes = true;
  const tools::CheckReport report = tools::check_and_mend(imported.surface, checks);
  if (!report.usable()) throw Problem(path + ": " + report.refused.front());
  return subject_of(std::move(imported.surface), std::filesystem::path(path).stem().string());
}

tools::DistanceField field_of(const Subject& subject, uint32_t cells) {
  tools::MapOptions options;
  options.interior_only = true;
  return tools::make_distance_field(
      subject.solids, tools::make_voxel_grid({subject.surface.get()}, cells), options);
}

// Centres of what the map computed, in the grid's order; `inside_only`: of those inside.
std::vector<tools::Point> centres_of(const tools::DistanceField& distance_field, bool inside_only) {
  std::vector<tools::Point> points;
  const tools::VoxelGrid& grid = distance_field.grid;
  for (uint32_t z = 0; z < grid.count[2]; ++z)
    for (uint32_t y = 0; y < grid.count[1]; ++y)
      for (uint32_t x = 0; x < grid.count[0]; ++x) {
        const int8_t sign = distance_field.values[grid.index(x, y, z)].sign;
        if (inside_only ? sign < 0 : sign != 0) points.push_back(grid.centre_m(x, y, z));
      }
  return points;
}

std::string fixed(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// Table 1 and figure 9: the share of time is another one, because the search is: eight boxes or
// triangles at a time, cubes of voxels at once.
void table_1(const Subject& subject, Report& report) {
  std::vector<std::string> heads{"cells",      "voxels",  "total s",
                                 "distance s", "share %", "us a voxel"};
  if (subject.is_bunny)
    for (const char* head : {"paper: voxels", "ours / paper", "total s", "distance s", "share %"})
      heads.push_back(head);
  std::vector<std::vector<std::string>> rows;
  double shares = 0;
  for (const Row& paper : kPaper) {
    report.stage(subject.name + ", " + std::to_string(paper.cells) + " cells");
    const tools::DistanceField distance_field = field_of(subject, paper.cells);
    const double total_s = distance_field.voxelize_s + distance_field.distance_s,
                 share = distance_field.distance_s / total_s;
    const double voxels = static_cast<double>(distance_field.computed);
    shares += share / 4;
    std::vector<std::string> row{
        std::to_string(paper.cells), std::to_string(distance_field.computed),
        fixed(total_s, 3),           fixed(distance_field.distance_s, 3),
        fixed(100 * share, 0),       fixed(distance_field.distance_s * 1e6 / voxels, 2)};
    if (subject.is_bunny) {
      row.push_back(std::to_string(paper.voxels));
      row.push_back(fixed(voxels / static_cast<double>(paper.voxels), 3));
      row.push_back(fixed(paper.total_s, 3));
      row.push_back(fixed(paper.distance_s, 3));
      row.push_back(fixed(100 * paper.distance_s / paper.total_s, 0));
    }
    rows.push_back(row);
    report.figure("voxels where flood and pseudonormal differ, " + std::to_string(paper.cells),
                  subject.name, static_cast<double>(distance_field.disagreements.size()), "");
  }
  report.table(heads, rows);
  report.figure("share of the time spent on distance, mean", subject.name, 100 * shares, "%",
                "the paper: 86");
}

void variants(const Subject& subject, const Options& options, Report& report) {
  const uint32_t cells = options.is_long ? 75 : 30;
  report.stage(subject.name + ", the published search");
  const std::vector<tools::Point> points = centres_of(field_of(subject, cells), false);
  const tools::TriangleTree tree(*subject.surface, 1);
  std::vector<std::vector<std::string>> rows;
  const auto run = [&](const std::string& name, const tools::MorrisSearch::Options& how) {
    std::vector<std::string> row{name};
    for (const bool depth_first : {true, false}) {
      tools::MorrisSearch search(tree, {how.ascend, how.is_seeded, depth_first});
      const auto begin = std::chrono::steady_clock::now();
      for (const tools::Point& p : points) search.nearest(tree.local(p));
      const double us =
          std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
              .count();
      const double count = static_cast<double>(points.size());
      row.push_back(fixed(static_cast<double>(search.boxes_read()) / count, 1));
      row.push_back(fixed(us / count, 2));
    }
    rows.push_back(row);
  };
  run("no seed", {0, false, true});
  for (const uint32_t ascend : {0u, 1u, 2u, 4u, 8u, 12u, 16u})
    run(std::to_string(ascend), {ascend, true, true});
  report.table({"TREE_ASCEND_N at " + std::to_string(cells) + " cells",
                "depth-first: boxes a voxel", "us", "breadth-first: boxes a voxel", "us"},
               rows);
}

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

// Morris 2006, section 3.4: Table 1, figure 9, TREE_ASCEND_N, depth- and breadth-first; and the bar of
// the interior field.
void run_morris(const Options& options, Report& report) {
  const Peer peer(options.peer);
  std::vector<Subject> subjects;
  for (const std::string& path : options.models) subjects.push_back(load(path));
  if (subjects.empty()) subjects.push_back(subject_of(tools::make_part(1, 20000), "part"));
  for (const Subject& subject : subjects) {
    report.heading("interior distance fields: " + subject.name);
    table_1(subject, report);
    variants(subject, options, report);
    bar(subject, peer, report);
  }
}

}  // namespace firmtouch::bench
