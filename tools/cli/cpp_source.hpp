#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// A C++ source that holds the asset as `extern const unsigned char SYMBOL[]`, 16-byte aligned, and
/// `extern const unsigned SYMBOL_size`: for builds without this project's CMake functions.
std::string cpp_source(const std::vector<uint8_t>& asset, const std::string& symbol);

/// "part 2.fta" gives "part_2_fta".
std::string symbol_of(const std::string& file_name);

}  // namespace firmtouch::cli
