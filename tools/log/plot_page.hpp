#pragma once
#include <string>

namespace firmtouch::log {

/// An HTML page around a plot: `svg`, `text` below it, and a cursor that shows the time and the
/// values under the pointer. It needs no other file.
std::string page_of(const std::string& title, const std::string& svg, const std::string& text);

}  // namespace firmtouch::log
