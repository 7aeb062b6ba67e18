#pragma once
#include <functional>
#include <string>

namespace firmtouch::host_sim {

/// Progress bar on stderr; an empty function if stderr is not a terminal.
std::function<void(double)> progress_bar(const std::string& what);

}  // namespace firmtouch::host_sim
