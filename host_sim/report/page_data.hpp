#pragma once
#include <string>

#include "host_sim/report/report.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"

namespace firmtouch::host_sim {

/// Data of the page's script as JSON: mesh, paths, and the charts' values.
std::string data_of(const Report& report, const Scene3d& scene3d, const RunCharts& run);

std::string hex_of(Colour colour);

}  // namespace firmtouch::host_sim
