#pragma once
#include "cli/arguments.hpp"
#include "hull/build_hull.hpp"

namespace firmtouch::cli {

/// The limits and the grid that the options of a command request. Fails (usage) on a value without
/// meaning.
tools::HullOptions hull_options(const Arguments& arguments);

}  // namespace firmtouch::cli
