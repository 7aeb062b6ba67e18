#pragma once
#include <functional>
#include <string>

#include "cli/arguments.hpp"

namespace firmtouch::host_sim {

/// --wait S: how long a controller may take to answer.
cli::Option wait_option();
double wait_s(const cli::Arguments& options);

/// Progress bar on stderr; an empty function if stderr is not a terminal.
std::function<void(double)> progress_bar(const std::string& what);

}  // namespace firmtouch::host_sim
