#pragma once
#include <string>

#include "host_sim/report/report.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/stage.hpp"

namespace firmtouch::host_sim {

/// What the page's script draws and tells from, as JSON: the part, the paths, the charts' values.
std::string data_of(const Report& report, const Stage& stage, const RunCharts& run);

std::string hex_of(Colour colour);

}  // namespace firmtouch::host_sim
