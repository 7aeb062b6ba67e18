#include <chrono>

#include "bench/field_subjects.hpp"
#include "lab/morris_search.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

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

}  // namespace

// Morris 2006, section 3.4: Table 1, figure 9, TREE_ASCEND_N, depth- and breadth-first.
void run_morris(const Options& options, Report& report) {
  for (const Subject& subject : field_subjects(options)) {
    report.heading("interior distance fields: " + subject.name);
    table_1(subject, report);
    variants(subject, options, report);
  }
}

}  // namespace firmtouch::lab
