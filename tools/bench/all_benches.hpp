#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

// The benches, one a file of that name; what each prints stands above its definition.
using Run = void(const Options& options, Report& report);
Run run_certificates, run_curve, run_distance, run_field, run_hull_queries, run_ring, run_segment,
    run_spline_race, run_touch, run_truth, run_velocity;

}  // namespace firmtouch::bench
