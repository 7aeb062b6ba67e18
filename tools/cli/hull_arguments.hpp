#pragma once
#include "cli/arguments.hpp"
#include "hull/build_hull.hpp"

namespace firmtouch::cli {

/// The options of a command, and behind them those of every hull.
std::vector<Option> with_hull_options(std::vector<Option> own);

/// What these request. Fails (usage) on a value without meaning.
tools::HullOptions hull_options(const Arguments& arguments);

}  // namespace firmtouch::cli
