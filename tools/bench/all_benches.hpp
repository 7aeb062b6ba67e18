#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

// The benches, one a file of that name; what each prints stands above its definition.
void run_curve(const Options& options, Report& report);
void run_distance(const Options& options, Report& report);
void run_field(const Options& options, Report& report);
void run_hull_queries(const Options& options, Report& report);
void run_ring(const Options& options, Report& report);
void run_segment(const Options& options, Report& report);
void run_spline_race(const Options& options, Report& report);
void run_truth(const Options& options, Report& report);
void run_velocity(const Options& options, Report& report);

}  // namespace firmtouch::bench
