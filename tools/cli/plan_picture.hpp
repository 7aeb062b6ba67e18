#pragma once
#include <string>

#include "cli/planner.hpp"

namespace firmtouch::cli {

/// A bar of flash for each way to bake, in its parts, and a line where flash ends, as SVG.
std::string plan_picture(const Planner& planner, uint64_t flash);

}  // namespace firmtouch::cli
