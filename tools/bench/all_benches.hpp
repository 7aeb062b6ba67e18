#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

// The benches, one a file of that name; what each prints stands above its definition.
void run_distance(const Options& options, Report& report);       // distance.cpp
void run_orders(const Options& options, Report& report);         // orders.cpp
void run_pseudonormals(const Options& options, Report& report);  // pseudonormals.cpp
void run_pyramids(const Options& options, Report& report);       // pyramids.cpp
void run_truth(const Options& options, Report& report);          // truth.cpp
void run_grid(const Options& options, Report& report);           // grid.cpp
void run_ring(const Options& options, Report& report);           // ring.cpp
void run_curve(const Options& options, Report& report);          // curve.cpp
void run_morris(const Options& options, Report& report);         // morris.cpp
void run_hull_queries(const Options& options, Report& report);
void run_hulls(const Options& options, Report& report);    // hulls.cpp
void run_segment(const Options& options, Report& report);  // segment.cpp
void run_hulls(const Options& options, Report& report);    // hulls.cpp
void run_segment(const Options& options, Report& report);  // segment.cpp
void run_splines(const Options& options, Report& report);  // splines.cpp
void run_cells(const Options& options, Report& report);    // cells.cpp

}  // namespace firmtouch::bench
