#pragma once
#include <string>

namespace firmtouch::tools {

/// `text` as a JSON string, quotes included.
std::string json_text(const std::string& text);

}  // namespace firmtouch::tools
