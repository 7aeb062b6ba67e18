#pragma once
#include <string>
#include <utility>
#include <vector>

namespace firmtouch::host_sim {

/// Files of a command: as the command line calls each ("--log", "the scenario"), and its path.
/// Empty paths were not given.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

/// Before any work: throws Usage where an output is one of the inputs, or another output, by
/// whatever path; Refused where an output cannot be written.
void check_outputs(const NamedFiles& inputs, const NamedFiles& outputs);

}  // namespace firmtouch::host_sim
