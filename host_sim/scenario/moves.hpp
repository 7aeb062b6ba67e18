#pragma once
#include <string>

#include "device/line_reader.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

bool is_move(const std::string& name);
/// The rest of a line of the hand's script that begins with `name`.
Move read_move(const std::string& name, tools::LineReader& words);

}  // namespace firmtouch::host_sim
