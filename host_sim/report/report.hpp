#pragma once
#include <string>

#include "host_sim/plant/environment.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// Input of a report. Holds references, which must outlive it.
struct Report {
  const Scenario& scenario;
  const Environment& environment;
  const RunFacts& facts;
  const Summary& summary;
  const RunCharts& charts;
  const RunPaths& paths;
  std::string asset_path;
  uint32_t asset_bytes;
  std::string scene;    // Session::scene_text()
  std::string command;  // command line of the run
};

/// The report as one HTML file that needs no network: charts and 3D view are drawn by its script.
std::string page_of(const Report& report);

/// The 3D view and the first charts as one SVG (for a README).
std::string picture_of(const Report& report);

}  // namespace firmtouch::host_sim
