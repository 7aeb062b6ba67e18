#include "lab/cell_atlas.hpp"

#include <algorithm>
#include <cmath>

#include "bake/spline/bake_spline.hpp"
#include "bench/problem.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "lab/trials.hpp"
#include "spline/sample_splines.hpp"

// Of planar curves: cells that list what may be nearest, beside the tree that is baked.

namespace firmtouch::lab {
namespace {

constexpr double kStep = 0.002;  // of the extent, a move

// What the tree's query takes on the Cortex-M7, fitted to the means counted on ten other planar
// cubics (November 2026, tools/bench/cortex-m7-spline; within 1 % of each): by itself, an
// evaluation with its proof, and a node. Of cells by what would be done: two comparisons and an
// index a level, and the ends, the start and the certificate of an entry.
constexpr double kQuery = 590, kEvaluation = 250, kRationalEvaluation = 300, kNode = 85;
constexpr double kLevel = 12, kEntry = 60;

struct Sum {
  double entries = 0, evaluations = 0, steps = 0, cost = 0;
  uint32_t max_entries = 0, max_evaluations = 0;
  double worst_cost = 0;

  void add(uint32_t listed, uint32_t evaluated, uint32_t nodes, double instructions) {
    entries += listed, evaluations += evaluated, steps += nodes, cost += instructions;
    max_entries = std::max(max_entries, listed);
    max_evaluations = std::max(max_evaluations, evaluated);
    worst_cost = std::max(worst_cost, instructions);
  }
  std::string evaluated(double queries) const {
    return number_text(evaluations / queries) + " / " + std::to_string(max_evaluations);
  }
  std::string costs(double queries) const {
    return number_text(std::round(cost / queries)) + " / " + number_text(worst_cost);
  }
};

std::vector<std::string> row_of(uint64_t seed, int levels, size_t positions, size_t& wrong) {
  tools::SplineModel model;
  model.curves.push_back(tools::winding_curve(seed, 9 + seed, true, seed % 2 == 0));
  tools::SplineReport baked;
  const std::vector<tools::Section> sections =
      tools::bake_spline(model, "curve", tools::curve_detail(false), baked);
  if (!baked.problem.empty()) throw Problem(baked.problem);
  spline::View view;
  if (!tools::open_baked(sections, "curve", view).ok())
    throw Problem("a baked curve does not open");
  CellAtlas::Options options;
  options.levels = levels;
  const CellAtlas atlas(model.curves[0], options);
  const spline::Head& head = view.head();
  const double slack_m = 1.5 * 0x1p-24 * baked.extent_m;
  const auto corner = [](const float(&at)[3]) {
    return tools::Point{static_cast<double>(at[0]), static_cast<double>(at[1]), 0};
  };
  const double each = baked.is_rational ? kRationalEvaluation : kEvaluation;
  Sum cells, tree;
  double queries = 0;
  spline::CurveHint hint;
  CellAtlas::Last last;
  for (const tools::Point& p :
       tools::path_about(tools::wandering_path(seed, positions, kStep, 0.5, 0.5),
                         corner(head.low_m), corner(head.high_m))) {
    const spline::Closest c = closest_point(view, tools::to_vec3(p), query::kUnlimited, hint);
    const CellAtlas::Answer a = atlas.closest(p.x, p.y, slack_m, last);
    if (!a.is_inside) continue;
    queries += 1;
    const uint32_t nodes = c.certificate.steps - c.evaluations;
    tree.add(0, c.evaluations, nodes, kQuery + each * c.evaluations + kNode * nodes);
    cells.add(a.entries, a.evaluations, 0,
              kQuery + kLevel * levels + kEntry * a.entries + each * a.evaluations);
    const double off = std::fabs(a.distance_m - static_cast<double>(c.distance_m));
    if (!(off <= 1e-6 * baked.extent_m)) ++wrong;
  }
  const CellAtlas::Shares shares = atlas.shares();
  const size_t curve_bytes =
      view.pieces().size() * sizeof(spline::Piece) + view.coefficients().size() * sizeof(float);
  const auto percent = [](double share) { return number_text(std::round(1000 * share) / 10); };
  return {std::to_string(seed) + (baked.is_rational ? ", weights" : ""),
          std::to_string(baked.bytes),
          std::to_string(atlas.bytes() + curve_bytes),
          std::to_string(atlas.leaves()),
          percent(shares.one) + " / " + percent(shares.two) + " / " + percent(shares.more),
          percent(shares.uncertain),
          number_text(cells.entries / queries) + " / " + std::to_string(cells.max_entries),
          number_text(tree.steps / queries),
          tree.evaluated(queries),
          cells.evaluated(queries),
          tree.costs(queries),
          cells.costs(queries)};
}

}  // namespace

void run_cells(const Options& options, Report& report) {
  if (!options.models.empty()) throw Problem("cells takes no models: it makes its curves itself");
  for (const int levels : {5, 6, 7}) {
    report.heading(
        "10 planar cubics, cells of " + std::to_string(levels) +
        " levels; paths of 0.2 % of the extent a query, each begun ahead of the last one");
    std::vector<std::vector<std::string>> rows;
    size_t wrong = 0;
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      report.stage("curve " + std::to_string(seed) + " of 10");
      rows.push_back(row_of(seed, levels, options.is_long ? 10001 : 2001, wrong));
    }
    report.table({"curve", "tree, B", "cells, B", "leaves", "1 / 2 / more entries, %",
                  "uncertain, %", "entries", "nodes", "tree: evaluated", "cells: evaluated",
                  "tree: instructions", "cells: instructions"},
                 rows);
    report.bar("answers that differ", "", static_cast<double>(wrong), "", 0);
  }
  report.figure("instructions assumed: a query", "", kQuery, "",
                "an evaluation with its proof " + number_text(kEvaluation) + ", with weights " +
                    number_text(kRationalEvaluation) + ", a node " + number_text(kNode) +
                    ", a level of cells " + number_text(kLevel) + ", an entry " +
                    number_text(kEntry));
}

}  // namespace firmtouch::lab
