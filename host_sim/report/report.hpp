#pragma once
#include <string>

#include "host_sim/plant/environment.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// All that a report tells of. Refers to its parts; they must outlive it.
struct Report {
  const Scenario& scenario;
  const World& world;
  const Trace& trace;
  const Summary& summary;
  std::string asset_path;
  uint32_t asset_bytes;
  std::string command;  // that made it
};

/// One HTML file, complete in itself: no network, any browser; charts as SVG, the part on a canvas.
std::string page_of(const Report& report);

/// Its first picture, part and force, as one SVG (for a README).
std::string picture_of(const Report& report);

}  // namespace firmtouch::host_sim
