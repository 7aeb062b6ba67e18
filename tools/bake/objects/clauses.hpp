#pragma once
#include <functional>
#include <string>

#include "device/line_reader.hpp"
#include "firmtouch/scene/stored_name.hpp"

// Words that lines of objects and of materials share.
namespace firmtouch::tools {

/// Reads a name that fits `to`, which is zero. Result: the name.
std::string read_name(LineReader& words, const char* what, char (&to)[scene::kNameBytes]);

/// Calls `read` with the first word of each clause up to the line's end; none may come twice.
void read_clauses(LineReader& words, const std::function<void(const std::string& word)>& read);

/// Behind `friction`: a number, then perhaps `sliding` and another; else both are the first.
void read_friction(LineReader& words, float most, float& at_rest, float& sliding);

}  // namespace firmtouch::tools
