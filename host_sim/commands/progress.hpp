#pragma once
#include <functional>
#include <string>

namespace firmtouch::host_sim {

/// A bar on stderr where that is a terminal; elsewhere one that says nothing.
std::function<void(double)> progress_bar(const std::string& what);

}  // namespace firmtouch::host_sim
