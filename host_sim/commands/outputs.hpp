#pragma once
#include <string>
#include <utility>
#include <vector>

namespace firmtouch::host_sim {

/// Files of a command: name for messages ("--log", "the scenario") and path; empty: not given.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

/// Checks the outputs before any work. Throws Usage if an output is the same file as an input or
/// another output, Refused if an output cannot be written.
void check_outputs(const NamedFiles& inputs, const NamedFiles& outputs);

}  // namespace firmtouch::host_sim
