#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace firmtouch::host_sim {

/// Energy that linkage, controller and contact give to `hands` random hands, to as many with a
/// mass, and to the worst that hill climbing finds with as many runs: at most 1 mJ. The same
/// without a limit shows that the bar can fail.
void study_passivity(const std::vector<std::string>& machines, uint32_t hands,
                     const std::function<void(double)>& progress, bench::Report& report);

}  // namespace firmtouch::host_sim
