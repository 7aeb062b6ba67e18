#pragma once
#include <string>
#include <vector>

#include "host_sim/controllers/session.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// "KEY=VALUE" of an option as a scenario's line "KEY VALUE"; "mass=1kg" as "mass 1 kg".
/// Throws Usage.
std::string line_of(std::string set);

/// Reads and completes a scenario; `sets`: further lines. Throws Refused.
Scenario prepared(const std::string& file, const std::string& text,
                  const std::vector<std::string>& sets);

/// The linkage that the scenario names, which must be the one that the controller drives.
/// Throws Refused.
void read_linkage(Scenario& scenario, const Session& session, const std::string& file);

}  // namespace firmtouch::host_sim
