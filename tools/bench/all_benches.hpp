#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

// The benches, one a file of that name; what each prints stands above its definition.
void run_distance(const Options& options, Report& report);  // distance.cpp

}  // namespace firmtouch::bench
