#pragma once
#include <string>
#include <vector>

#include "chart/chart.hpp"
#include "host_sim/report/report.hpp"

namespace firmtouch::host_sim {

using chart::Chart;
using chart::ChartSize;
using chart::fixed;
using chart::grouped;
using chart::html_of;
using chart::Series;
using chart::TimeAxis;

/// The charts of a run, most important first: force, penetration, distance with its bound, visits,
/// guide, speed, and instructions if they were counted.
struct RunCharts {
  std::vector<Chart> charts;
  std::vector<std::string> notes;  // explanation of each chart
  TimeAxis axis;
};

RunCharts make_charts(const Report& report);

}  // namespace firmtouch::host_sim
