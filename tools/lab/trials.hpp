#pragma once
#include "bench/bench.hpp"

namespace firmtouch::lab {

using namespace bench;  // NOLINT: the lab is built on the benches' models, timing and report

/// Every trial there is: tables and figures of the papers, and designs that lost (JOURNAL.md).
std::vector<Bench> trials();

// The trials, one a file of that name; what each prints stands above its definition.
using Run = void(const Options& options, Report& report);
Run run_cells, run_curve_constraint, run_curve_drag, run_grid, run_hull_tables, run_hulls,
    run_morris, run_orders, run_pictures, run_pseudonormals, run_pyramids, run_splines;

}  // namespace firmtouch::lab
