#pragma once
#include <functional>
#include <optional>
#include <string>

#include "device/device_file.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/report/vtk.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

struct VtkExport {
  uint32_t every = 16;     // ticks
  double period_s = 1e-3;  // of a tick
  float tool_radius_m = 0;
  std::optional<tools::LinkageDevice> linkage = {};  // its links are drawn
};

/// Writes a run into the folder: run.pvd, which names the others; tick_N.vtp with links, tip,
/// proxy, force and velocity; and scene_N.vtp, surface and guide in the device frame, anew where
/// objects have moved. Result: how many ticks. Throws Refused if a file cannot be written.
uint32_t export_vtk(const Log& log, const Environment& environment, const VtkExport& what,
                    const std::string& folder, const std::function<void(double)>& progress);

}  // namespace firmtouch::host_sim
