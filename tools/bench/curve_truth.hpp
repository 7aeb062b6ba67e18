#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

/// Ten curves of uneven samples that pass near themselves: answers that differ from brute force in
/// double, without and with a penalty. A track that passes beside itself: jumps, by the weight.
void run_curve_truth(const Options& options, Report& report);

}  // namespace firmtouch::bench
