#pragma once
#include "bench/bench.hpp"

namespace firmtouch::lab {

using namespace bench;  // NOLINT: the lab is built on the benches' models, timing and report

/// Every trial there is: tables and figures of the papers, and designs that lost (JOURNAL.md).
const std::vector<Bench>& trials();

// The trials, one a file of that name; what each prints stands above its definition.
void run_cells(const Options& options, Report& report);
void run_curve_constraint(const Options& options, Report& report);
void run_curve_drag(const Options& options, Report& report);
void run_grid(const Options& options, Report& report);
void run_hull_tables(const Options& options, Report& report);
void run_hulls(const Options& options, Report& report);
void run_morris(const Options& options, Report& report);
void run_orders(const Options& options, Report& report);
void run_pictures(const Options& options, Report& report);
void run_pseudonormals(const Options& options, Report& report);
void run_pyramids(const Options& options, Report& report);
void run_splines(const Options& options, Report& report);

}  // namespace firmtouch::lab
