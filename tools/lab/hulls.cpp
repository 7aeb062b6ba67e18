#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "bench/models.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "hull/build_hull.hpp"
#include "lab/published_refinement.hpp"
#include "lab/trials.hpp"
#include "surface/random.hpp"

namespace firmtouch::lab {
namespace {

using tools::HullOptions;
using tools::HullReport;
using tools::HullStrategy;
using tools::ProgressiveHull;
using tools::QueueKind;

// What the paper reports of the models that are at hand (Platis & Theoharis 2003, tables 1 and 2).
struct Reported {
  const char* model;
  double seconds[2];  // strategies 1 and 2
  double void_2000[2], void_200[2];
  // The project's bars: strategy 1 and lazy.
  double most_2000[2], most_200[2];
  uint32_t crossing;  // of 10,000 segments (table 4)
};
constexpr Reported kReported[] = {
    {"rocker-arm", {54, 8}, {2.87, 5.72}, {28.90, 62.91}, {2.95, 3.1}, {30, 33}, 2044},
    {"horse", {298, 45}, {4.11, 6.86}, {65.06, 65.60}, {4.2, 4.3}, {65, 52}, 1119},
};
const Reported* reported_of(const Model& model) {
  for (const Reported& reported : kReported) {
    if (model.name == reported.model) return &reported;
  }
  return nullptr;
}

// Table 3: faces of the base; by either strategy tests, splits.
struct HorseRow {
  uint32_t base;
  double tests[2], splits[2];
};
constexpr HorseRow kHorse[] = {{200, {759, 798}, {226, 238}},    {500, {812, 868}, {203, 217}},
                               {1000, {939, 986}, {179, 192}},   {2000, {1209, 1254}, {145, 155}},
                               {3000, {1522, 1550}, {124, 131}}, {4000, {1841, 1871}, {108, 114}},
                               {5000, {2176, 2200}, {96, 100}},  {10000, {3904, 3907}, {61, 63}}};

constexpr HullStrategy kStrategies[] = {HullStrategy::kVolume, HullStrategy::kCentre,
                                        HullStrategy::kLazyVolume};
constexpr const char* kNames[] = {"1", "2", "lazy"};

ProgressiveHull built(const Model& model, HullStrategy strategy, uint32_t faces, HullReport& report,
                      QueueKind queue = QueueKind::kTree) {
  HullOptions options;
  options.strategy = strategy;
  options.target_faces = faces;
  options.queue = queue;
  return tools::build_hull(model.surface, options, report);
}

double void_percent(const Model& model, const ProgressiveHull& hull, uint32_t faces) {
  if (hull.min_faces() > faces) return NAN;
  const double before = tools::enclosed_volume_m3(model.surface);
  return 100 * (tools::enclosed_volume_m3(tools::hull_level(hull, faces)) - before) / before;
}

std::string percent(double value) {
  return std::isnan(value) ? "stalls above" : number_text(value);
}

double seconds_of(const Model& model, HullStrategy strategy, QueueKind queue) {
  const auto begin = std::chrono::steady_clock::now();
  HullReport report;
  (void)built(model, strategy, 2000, report, queue);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Table 1. Times in turn, medians; the counts are exact.
void run_times(const Model& model, bool is_long, Report& report) {
  const Reported* reported = reported_of(model);
  std::vector<double> seconds[3], heap;
  for (int pass = 0; pass < (is_long ? 5 : 3); ++pass) {
    report.stage("hulls of 2,000 faces, " + model.name);
    for (int s = 0; s < 3; ++s)
      seconds[s].push_back(seconds_of(model, kStrategies[s], QueueKind::kTree));
    heap.push_back(seconds_of(model, HullStrategy::kVolume, QueueKind::kHeap));
  }
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  std::vector<std::vector<std::string>> rows;
  HullReport reports[3];
  for (int s = 0; s < 3; ++s) {
    (void)built(model, kStrategies[s], 2000, reports[s]);
    rows.push_back({kNames[s], number_text(median(seconds[s])),
                    reported != nullptr && s < 2 ? number_text(reported->seconds[s]) : "-",
                    std::to_string(reports[s].counts.programs),
                    std::to_string(reports[s].counts.evaluations),
                    std::to_string(reports[s].counts.comparisons)});
  }
  HullReport with_heap;
  (void)built(model, HullStrategy::kVolume, 2000, with_heap, QueueKind::kHeap);
  rows.push_back(
      {"1, binary heap", number_text(median(heap)), "-", std::to_string(with_heap.counts.programs),
       std::to_string(with_heap.counts.evaluations), std::to_string(with_heap.counts.comparisons)});
  report.table({"strategy", "seconds to 2,000 faces", "the paper's", "linear programs",
                "edges looked at", "comparisons of keys"},
               rows);
  report.figure("time, strategy 1 over strategy 2", model.name,
                median(seconds[0]) / median(seconds[1]), "x",
                reported != nullptr
                    ? "the paper's: " + number_text(reported->seconds[0] / reported->seconds[1])
                    : "");
  report.figure("time, binary heap over ordered tree, strategy 1", model.name,
                median(heap) / median(seconds[0]), "x");
  report.bar("time, lazy over strategy 1", model.name, median(seconds[2]) / median(seconds[0]), "x",
             0.45);
  if (model.name == "horse") {
    report.bar("linear programs, lazy", model.name, static_cast<double>(reports[2].counts.programs),
               "", 750000);
  }
}

// Table 2.
void run_voids(const Model& model, Report& report) {
  const Reported* reported = reported_of(model);
  std::vector<std::vector<std::string>> rows;
  for (int s = 0; s < 3; ++s) {
    report.stage(std::string("void, strategy ") + kNames[s] + ", " + model.name);
    HullReport ignored;
    const ProgressiveHull hull = built(model, kStrategies[s], 200, ignored);
    const double at_2000 = void_percent(model, hull, 2000), at_200 = void_percent(model, hull, 200);
    const bool is_reported = reported != nullptr && s < 2;
    rows.push_back({kNames[s], percent(at_2000),
                    is_reported ? number_text(reported->void_2000[s]) : "-", percent(at_200),
                    is_reported ? number_text(reported->void_200[s]) : "-"});
    if (reported == nullptr || s == 1) continue;
    const std::string name = std::string(", strategy ") + kNames[s];
    report.bar("void at 2,000 faces" + name, model.name, at_2000, "%", reported->most_2000[s / 2]);
    report.bar("void at 200 faces" + name, model.name, at_200, "%", reported->most_200[s / 2]);
  }
  report.table(
      {"strategy", "void at 2,000 faces, %", "the paper's", "void at 200 faces, %", "the paper's"},
      rows);
}

// Looser limits, coarser grids, and where each stalls.
void run_limits(const Model& model, Report& report) {
  const struct {
    const char* name;
    uint32_t valence;
    double compactness, deviation_deg;
    uint32_t bits;
    HullStrategy strategy;
  } kLimits[] = {{"12, 0.8, 45 deg, strategy 1", 12, 0.8, 45, 22, HullStrategy::kVolume},
                 {"12, 0.8, 45 deg, strategy 2", 12, 0.8, 45, 22, HullStrategy::kCentre},
                 {"12, 0.8, 45 deg, lazy", 12, 0.8, 45, 22, HullStrategy::kLazyVolume},
                 {"12, 0.8, 45 deg, lazy, 16-bit grid", 12, 0.8, 45, 16, HullStrategy::kLazyVolume},
                 {"12, 0.5, 45 deg, lazy", 12, 0.5, 45, 22, HullStrategy::kLazyVolume},
                 {"16, 0.5, 60 deg, lazy", 16, 0.5, 60, 22, HullStrategy::kLazyVolume},
                 {"20, 0.2, 90 deg, lazy", 20, 0.2, 90, 22, HullStrategy::kLazyVolume}};
  std::vector<std::vector<std::string>> rows;
  for (const auto& limits : kLimits) {
    report.stage(std::string("limits ") + limits.name + ", " + model.name);
    HullOptions options;
    options.target_faces = 4;
    options.strategy = limits.strategy;
    options.limits.max_valence = limits.valence;
    options.limits.compactness = limits.compactness;
    options.limits.max_deviation_deg = limits.deviation_deg;
    options.grid_bits = limits.bits;
    HullReport built_report;
    const ProgressiveHull hull = tools::build_hull(model.surface, options, built_report);
    rows.push_back({limits.name, percent(void_percent(model, hull, 2000)),
                    percent(void_percent(model, hull, 200)), std::to_string(hull.min_faces())});
  }
  report.table({"valence, compactness, turn", "void at 2,000 faces, %", "void at 200 faces, %",
                "stalls at faces"},
               rows);
}

// Ends on two different sides of a box of twice the model's size.
std::vector<tools::Segment> segments(const Model& model, size_t count) {
  tools::Random random(1);
  const mesh::Head& head = model.view.head();
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    const double a = static_cast<double>(head.low_m[k]), b = static_cast<double>(head.high_m[k]);
    low[k] = a - 0.5 * (b - a);
    high[k] = b + 0.5 * (b - a);
  }
  const auto on_side = [&](uint32_t side) {
    double p[3];
    for (int k = 0; k < 3; ++k) p[k] = random.between(low[k], high[k]);
    p[side / 2] = side % 2 == 0 ? low[side / 2] : high[side / 2];
    return tools::Point{p[0], p[1], p[2]};
  };
  std::vector<tools::Segment> all;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t side = random.below(6), other = (side + 1 + random.below(5)) % 6;
    const tools::Point from = on_side(side);
    const tools::Point to = on_side(other);
    // Floats, so that the mesh can be queried for the truth.
    all.push_back({tools::to_point(tools::to_vec3(from)), tools::to_point(tools::to_vec3(to))});
  }
  return all;
}

struct Misses {
  size_t segments = 0;  // that cross
  size_t crossings = 0, missed = 0, extra = 0, wrong_ends = 0;
};

// What the refinement returned for a segment, against all that the segment crosses.
void compare(const Model& model, const tools::Segment& segment,
             const std::vector<tools::SegmentHit>& found, Misses& misses) {
  mesh::SurfaceCrossing room[256];
  const mesh::Crossings truth =
      mesh::all_crossings(model.view, tools::to_vec3(segment.from_m), tools::to_vec3(segment.to_m),
                          query::kUnlimited, core::Span<mesh::SurfaceCrossing>(room, 256));
  misses.segments += truth.found > 0 ? 1u : 0u;
  misses.crossings += truth.found;
  misses.missed += truth.found > found.size() ? truth.found - found.size() : 0;
  misses.extra += found.size() > truth.found ? found.size() - truth.found : 0;
  if (truth.reported == 0 || found.empty()) {
    misses.wrong_ends += (truth.reported == 0) == found.empty() ? 0u : 1u;
    return;
  }
  const auto differ = [](double t, float u) {
    return std::fabs(t - static_cast<double>(u)) > 1e-5;
  };
  if (differ(found.front().t, room[0].t) || differ(found.back().t, room[truth.reported - 1].t))
    ++misses.wrong_ends;
}

// Figure 8 and the counts of table 3: the paper's algorithm, so in double and without its
// betterments.
void run_bases(const Model& model, HullStrategy strategy, Report& report) {
  HullReport ignored;
  report.stage("segments by base size, " + model.name);
  const ProgressiveHull hull = built(model, strategy, 200, ignored);
  const std::vector<tools::Segment> all = segments(model, 10000);
  const bool is_horse = model.name == "horse";
  const size_t column = strategy == HullStrategy::kVolume ? 0 : 1;
  size_t wrong_ends = 0, crossing = 0;
  std::vector<std::vector<std::string>> rows;
  for (const HorseRow& reported : kHorse) {
    const uint32_t base = reported.base;
    if (base < hull.min_faces() || base >= model.surface.faces.size()) continue;
    tools::Refinement refinement(hull, base);
    tools::RefinementCounts counts;
    std::vector<std::vector<tools::SegmentHit>> answers;
    answers.reserve(all.size());
    const auto begin = std::chrono::steady_clock::now();
    for (const tools::Segment& segment : all) answers.push_back(refinement.hits(segment, counts));
    const double us =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() * 1e6 /
        static_cast<double>(all.size());
    Misses misses;
    for (size_t i = 0; i < all.size(); ++i) compare(model, all[i], answers[i], misses);
    const double tests = static_cast<double>(counts.tests) / static_cast<double>(all.size());
    const double splits = static_cast<double>(counts.splits) / static_cast<double>(all.size());
    rows.push_back({std::to_string(refinement.base_face_count()), number_text(us),
                    number_text(tests), is_horse ? number_text(reported.tests[column]) : "-",
                    number_text(splits), is_horse ? number_text(reported.splits[column]) : "-",
                    std::to_string(misses.crossings), std::to_string(misses.missed),
                    std::to_string(misses.extra), std::to_string(misses.wrong_ends)});
    wrong_ends += misses.wrong_ends;
    crossing = misses.segments;
    if (!is_horse || base != 1000) continue;
    report.bar("tests at base 1,000 off the paper's " + number_text(reported.tests[column]),
               model.name, 100 * std::fabs(tests / reported.tests[column] - 1), "%", 3);
    report.bar("splits at base 1,000 off the paper's " + number_text(reported.splits[column]),
               model.name, 100 * std::fabs(splits / reported.splits[column] - 1), "%", 3);
  }
  // Without a hull: every face, for each segment that touches the box.
  const tools::Refinement none(hull, static_cast<uint32_t>(model.surface.faces.size()));
  size_t touching = 0;
  for (const tools::Segment& segment : all) touching += none.touches_box(segment) ? 1u : 0u;
  rows.push_back(
      {"no hull", "-",
       number_text(static_cast<double>(touching) * static_cast<double>(model.surface.faces.size()) /
                   static_cast<double>(all.size())),
       is_horse ? "35751" : "-", "0", "-", "-", "-", "-", "-"});
  report.table({"base, faces", "us a segment", "tests", "the paper's", "splits", "the paper's",
                "crossings", "missed", "extra", "first or last wrong"},
               rows);
  if (const Reported* published = reported_of(model); published != nullptr && column == 0) {
    report.figure("segments of 10,000 that cross the mesh", model.name,
                  static_cast<double>(crossing), "",
                  "the paper's: " + std::to_string(published->crossing));
  }
  report.bar(std::string("first or last hits wrong, from outside, strategy ") +
                 (strategy == HullStrategy::kVolume ? "1" : "2"),
             model.name, static_cast<double>(wrong_ends), "", 0);
}

}  // namespace

void run_hulls(const Options& options, Report& report) {
  for (const Model& model : load_models(options)) {
    report.heading("time to build a hull (table 1): " + model.name);
    run_times(model, options.is_long, report);
    report.heading("void space (table 2): " + model.name);
    run_voids(model, report);
    report.heading("looser limits and where they stall: " + model.name);
    run_limits(model, report);
    report.heading("segments by base size (figure 8, table 3), strategy 1: " + model.name);
    run_bases(model, HullStrategy::kVolume, report);
    report.heading("segments by base size (figure 8, table 3), strategy 2: " + model.name);
    run_bases(model, HullStrategy::kCentre, report);
  }
}

}  // namespace firmtouch::lab
