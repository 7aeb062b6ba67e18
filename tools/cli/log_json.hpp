#pragma once
#include <string>

#include "log/reader.hpp"
#include "log/statistics.hpp"

namespace firmtouch::cli {

/// What text_of() says, for programs.
std::string json_of(const log::Statistics& statistics);

/// The head, fields and bits of a log that was read through.
std::string json_of(const log::Reader& reader);

}  // namespace firmtouch::cli
