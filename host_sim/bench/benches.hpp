#pragma once
#include <vector>

#include "bench/bench.hpp"

namespace firmtouch::host_sim {

// What a controller renders on the simulated device, against closed forms. Each stands above its
// definition.
void run_contact_bench(const bench::Options& options, bench::Report& report);

const std::vector<bench::Bench>& rig_benches();

}  // namespace firmtouch::host_sim
