#pragma once
#include <memory>
#include <string>

#include "log/sink.hpp"

namespace firmtouch::log {

/// Whether it is a device or a pipe, which a renamed file would replace.
bool is_special(const std::string& path);

/// A file of this machine, made anew. Result: nullptr, and `problem` says why, where it cannot be
/// made.
std::unique_ptr<Sink> make_file(const std::string& path, std::string& problem);

}  // namespace firmtouch::log
