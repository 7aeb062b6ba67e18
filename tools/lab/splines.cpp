#include <cmath>
#include <cstdio>
#include <memory>

#include "bench/models.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "footpoint/tracker.hpp"
#include "lab/trials.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"

// The published method for splines at the published parameters: Seong, Johnson, Cohen, section 5.

namespace firmtouch::lab {
namespace {

using tools::CriticalGrid;
using tools::Footpoints;
using tools::Point;
using tools::Tracker;
using tools::TrackerCounts;
using tools::TrackerOptions;

constexpr double kMargin = 0.25;            // of the extent, that the cells reach beyond the model
constexpr double kStep = 0.002;             // of the extent, a move
constexpr double kWrong = 1e-7;             // of the extent
constexpr double kPublishedCurve_us = 130;  // 10,000 queries in 1.2 to 1.4 s, 2 GHz Pentium 4
constexpr double kPublishedSurface_us = 2500;  // 300 to 500 a second there

struct Case {
  std::string name;
  std::unique_ptr<Footpoints> feet;
  std::vector<Point> path;
  std::vector<double> truth_m;  // from scratch, at each position
};

Case case_of(const std::string& name, const std::vector<tools::BezierCurve>& curves,
             const std::vector<tools::BezierPatch>& patches, const std::vector<Point>& path) {
  Case c{name, std::make_unique<Footpoints>(curves, patches), {}, {}};
  c.path = tools::path_about(path, c.feet->low_m(), c.feet->high_m());
  for (const Point p : c.path) {
    bool is_complete = false;
    c.truth_m.push_back(c.feet->all(p, is_complete).front().distance_m);
  }
  return c;
}

/// What following all paths of some cases comes to.
struct Sum {
  TrackerCounts counts;
  size_t wrong = 0, carried = 0;
  double worst_m = 0, bake_s = 0;
  size_t marked = 0, cells = 0;
  double us = 0;  // a query

  double pruned() const {
    return 100 * static_cast<double>(counts.pruned) / static_cast<double>(counts.moves);
  }
  double steps() const {
    return static_cast<double>(counts.iterations) / static_cast<double>(counts.marches);
  }
};

void add(TrackerCounts& sum, const TrackerCounts& more) {
  sum.moves += more.moves, sum.pruned += more.pruned, sum.marches += more.marches;
  sum.iterations += more.iterations, sum.solves += more.solves, sum.anomalies += more.anomalies;
}

// Moves of `stride` positions each. Only where `is_timed` is the time measured, five passes more.
Sum follow(const std::vector<Case>& cases, int levels, const TrackerOptions& options, size_t stride,
           bool is_timed) {
  Sum sum;
  std::vector<std::unique_ptr<CriticalGrid>> grids;
  for (const Case& c : cases) {
    sum.bake_s += timed(1,
                        [&] {
                          grids.push_back(std::make_unique<CriticalGrid>(*c.feet, levels, kMargin));
                          return 0.0;
                        })() *
                  1e-6;
    const CriticalGrid& grid = *grids.back();
    sum.marked += grid.marked(), sum.cells += grid.cells();
    Tracker tracker(*c.feet, grid, options);
    tracker.start(c.path[0]);
    for (size_t k = stride; k < c.path.size(); k += stride) {
      tracker.move(c.path[k]);
      const double error = std::fabs(tracker.distance_m() - c.truth_m[k]);
      sum.wrong += !(error <= kWrong * c.feet->extent_m());
      sum.worst_m = std::fmax(sum.worst_m, error);
      sum.carried += tracker.count();
    }
    add(sum.counts, tracker.counts());
  }
  if (!is_timed) return sum;
  const auto pass = [&] {
    double total = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
      Tracker tracker(*cases[i].feet, *grids[i], options);
      tracker.start(cases[i].path[0]);
      for (size_t k = stride; k < cases[i].path.size(); k += stride) {
        tracker.move(cases[i].path[k]);
        total += tracker.distance_m();
      }
    }
    return total;
  };
  sum.us = medians_us({timed(sum.counts.moves, pass)})[0];
  return sum;
}

double from_scratch_us(const std::vector<Case>& cases, size_t each) {
  const auto pass = [&] {
    double total = 0;
    for (const Case& c : cases) {
      for (size_t k = 0; k < each; ++k) {
        bool is_complete = false;
        total += c.feet->all(c.path[k * (c.path.size() / each)], is_complete).front().distance_m;
      }
    }
    return total;
  };
  return medians_us({timed(cases.size() * each, pass)})[0];
}

std::string share(size_t part, uint64_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

std::vector<std::string> row_of(const std::string& what, const Sum& s) {
  return {what,
          share(s.wrong, s.counts.moves),
          number_text(s.worst_m),
          number_text(s.pruned()),
          number_text(s.steps()),
          number_text(static_cast<double>(s.carried) / static_cast<double>(s.counts.moves)),
          std::to_string(s.counts.solves),
          std::to_string(s.counts.anomalies)};
}

const std::vector<std::string> kHeads = {"",      "wrong",   "worst, m", "pruned, %",
                                         "steps", "carried", "solved",   "failed"};

double rate(double us) { return 1e6 / us; }

// What the paper says of a kind of shape, in its section 5; it says nothing of space curves.
struct Published {
  double us = 0;
  const char *rate = "", *pruned = "";
};

void report_shape(const std::string& shape, const Sum& s, const Sum& printed,
                  const std::vector<Case>& cases, const Published& published, size_t scratch,
                  Report& report) {
  report.figure("Newton steps a foot-point and move, the point kept fixed", shape, s.steps(), "");
  report.figure("the same, predicted as printed", shape, printed.steps(), "");
  report.figure("moves without a critical cell on their way", shape, s.pruned(), "%",
                published.pruned);
  report.figure("cells with a critical point", shape,
                100 * static_cast<double>(s.marked) / static_cast<double>(s.cells), "%");
  report.figure("critical cells baked, a shape", shape,
                s.bake_s / static_cast<double>(cases.size()), "s");
  report.figure("queries a second, carried along", shape, rate(s.us), "/s",
                published.us > 0
                    ? std::string("published: ") + published.rate + "; " +
                          number_text(published.us / s.us) + " x faster, on another machine"
                    : std::string());
  const double scratch_us = from_scratch_us(cases, scratch);
  report.figure("queries a second, each from scratch", shape, rate(scratch_us), "/s",
                number_text(scratch_us / s.us) + " x slower than carried along");
}

void run_curves(bool is_planar, bool is_long, Report& report) {
  const std::string shape = is_planar ? "10 planar cubics" : "10 space cubics";
  report.heading(shape + ", every second one rational; moves of 0.2 % of the extent");
  const size_t positions = is_long ? 10001 : 1001;
  std::vector<Case> cases;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    report.stage("truth of " + shape + ", " + std::to_string(seed));
    cases.push_back(
        case_of(std::to_string(seed),
                bezier_pieces(tools::winding_curve(seed, 9 + seed, is_planar, seed % 2 == 0)), {},
                tools::wandering_path(seed, positions, kStep, -0.2, 1.2)));
  }
  report.stage("following " + shape);
  const int levels = is_planar ? 5 : 4;
  Published published;
  if (is_planar)
    published = {kPublishedCurve_us, "10,000 in 1.2 to 1.4 s", "published: about 90 %"};
  TrackerOptions usual, printed, endless, bare;
  printed.predictor = tools::Predictor::kProjected;
  endless.watches_ends = false;
  bare.uses_grid = false;
  const Sum s = follow(cases, levels, usual, 1, true), p = follow(cases, levels, printed, 1, false);
  report_shape(shape, s, p, cases, published, positions / 20, report);
  const Sum without = follow(cases, levels, bare, 1, true);
  report.figure("without the cells, every piece tested for each move: time over time with", shape,
                without.us / s.us, "x", is_planar ? "published: about ten times" : "");
  report.figure("foot-points lost where ends are not watched, as published", shape,
                100 * static_cast<double>(follow(cases, levels, endless, 1, false).wrong) /
                    static_cast<double>(s.counts.moves),
                "%");
  std::vector<std::vector<std::string>> rows;
  for (const int level : is_planar ? std::vector<int>{4, 5, 6, 7} : std::vector<int>{3, 4, 5}) {
    for (const size_t stride : {1u, 5u, 25u}) {
      report.stage(shape + ", level " + std::to_string(level));
      const std::string what = "tolerance " + number_text((1 + 2 * kMargin) / (1 << level)) +
                               ", step " + number_text(kStep * static_cast<double>(stride));
      rows.push_back(row_of(what, follow(cases, level, usual, stride, false)));
    }
  }
  report.table(kHeads, rows);
}

void run_surfaces(std::vector<Case> cases, const std::string& shape, const std::vector<int>& levels,
                  Report& report) {
  report.stage("following " + shape);
  TrackerOptions usual, printed;
  printed.predictor = tools::Predictor::kProjected;
  const Sum s = follow(cases, levels[0], usual, 1, true);
  const Sum p = follow(cases, levels[0], printed, 1, false);
  Published published;
  if (!cases[0].feet->patches().empty()) published = {kPublishedSurface_us, "300 to 500 a second"};
  report_shape(shape, s, p, cases, published, cases[0].path.size() / 10, report);
  std::vector<std::vector<std::string>> rows;
  for (const int level : levels) {
    for (const size_t stride : {1u, 10u}) {
      report.stage(shape + ", level " + std::to_string(level));
      const std::string what =
          "tolerance " + number_text((1 + 2 * kMargin) / (1 << level) * cases[0].feet->extent_m()) +
          ", " + std::to_string(stride) + " positions a move";
      rows.push_back(row_of(what, follow(cases, level, usual, stride, false)));
    }
  }
  report.table(kHeads, rows);
}

Case model_case(const std::string& path, size_t positions) {
  const tools::SplineModel model = tools::read_spline_file(path, 0);
  if (!model.problem.empty()) throw Problem(model.problem);
  std::vector<tools::BezierCurve> curves;
  std::vector<tools::BezierPatch> patches;
  for (const tools::SplineCurve& c : model.curves)
    for (tools::BezierCurve& piece : bezier_pieces(c)) curves.push_back(std::move(piece));
  for (const tools::SplineSurface& s : model.surfaces)
    for (tools::BezierPatch& patch : bezier_pieces(s)) patches.push_back(std::move(patch));
  return case_of(path, curves, patches, tools::wandering_path(7, positions, kStep, -0.2, 1.2));
}

}  // namespace

void run_splines(const Options& options, Report& report) {
  if (!options.models.empty()) {
    for (const std::string& path : options.models) {
      report.heading("published method: " + path);
      std::vector<Case> cases;
      cases.push_back(model_case(path, options.is_long ? 2001 : 201));
      const bool has_patches = !cases[0].feet->patches().empty();
      run_surfaces(std::move(cases), path, has_patches ? std::vector<int>{4} : std::vector<int>{5},
                   report);
    }
  } else {
    run_curves(true, options.is_long, report);
    run_curves(false, options.is_long, report);
    report.heading("4 bicubic surfaces of 64 points, every second one rational");
    std::vector<Case> cases;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      report.stage("truth of surface " + std::to_string(seed));
      cases.push_back(
          case_of(std::to_string(seed), {},
                  bezier_pieces(tools::hilly_surface(seed, 8, 0.15, seed % 2 == 0)),
                  tools::wandering_path(seed, options.is_long ? 2001 : 201, kStep, 0.1, 0.9)));
    }
    run_surfaces(std::move(cases), "4 surfaces", {4, 5}, report);
  }
}

}  // namespace firmtouch::lab
