#pragma once
#include <string>

#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// Every tick as a row: all fields of its record under their names, then what only the simulator
/// knows (the device's true position, the hand's target and force, instructions). Numbers print as
/// %.9g.
std::string csv_of(const Trace& trace);

}  // namespace firmtouch::host_sim
