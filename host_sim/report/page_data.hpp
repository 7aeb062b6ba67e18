#pragma once
#include <string>

#include "host_sim/report/report.hpp"
#include "host_sim/report/scene3d.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {

/// Data of the report's script as JSON: mesh, paths, samples, and the charts' values.
std::string data_of(const Report& report, const Scene3d& scene3d);

/// Surface and paths as members of a JSON object, for the 3D view of a page.
std::string scene_data_of(const Scene3d& scene3d, const Environment& environment);

std::string hex_of(Colour colour);

using tools::json_text;

}  // namespace firmtouch::host_sim
