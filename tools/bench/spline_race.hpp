#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

/// Curves and surfaces, polynomial and with weights, against the global closest-point routine of another
/// library on the same points: ours with its certificate, warm and cold, and all foot-points from scratch.
void race_splines(const Options& options, Report& report);

}  // namespace firmtouch::bench
