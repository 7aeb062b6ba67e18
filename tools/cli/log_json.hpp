#pragma once
#include <string>

#include "log/statistics.hpp"

namespace firmtouch::cli {

/// What text_of() says, for programs.
std::string json_of(const log::Statistics& statistics);

}  // namespace firmtouch::cli
