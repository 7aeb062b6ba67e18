#pragma once
#include <vector>

#include "bench/all_benches.hpp"
#include "bench/bench.hpp"

namespace firmtouch::host_sim {

// What a controller renders on the simulated device, against closed forms. Each stands above its
// definition.
bench::Run run_contact_bench, run_moving_bench, run_friction_bench, run_passivity_bench;

std::vector<bench::Bench> rig_benches();

}  // namespace firmtouch::host_sim
