#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace firmtouch::host_sim {

/// Every failure at every `every`th tick of six touches of each machine, and what fails at
/// every `every`th tick of homing: ticks until it is a fault, from there until no motor pushes,
/// the largest torques, and what was done to the hand. On all cores. `only`: this failure alone,
/// and none in homing; empty: all.
void study_failures(const std::vector<std::string>& machines, uint32_t every,
                    const std::string& only, const std::function<void(double)>& progress,
                    bench::Report& report);

}  // namespace firmtouch::host_sim
