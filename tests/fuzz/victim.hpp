#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/core/status.hpp"

namespace firmtouch::fuzz {

/// A small asset with every section type of the format and an unknown one: a mesh with 16-bit
/// indices and a distance field, the same with 32-bit indices, an unsigned mesh, an open curve and
/// a closed one with a dropped row.
std::vector<uint8_t> make_victim();

/// Opens an asset like a controller and, if nothing is rejected, runs every query: at points that
/// include NaN and the limits, with small and large budgets. Checks that every answer is in range,
/// finite and within its budget. Each section is copied to its own allocation first, so that the
/// address sanitizer detects reads beyond it. `only`: name of the one asset to run, nullptr for
/// all. Result: the first rejection, or a pass.
core::Verdict exercise(const std::vector<uint8_t>& file, const char* only = nullptr);

}  // namespace firmtouch::fuzz
