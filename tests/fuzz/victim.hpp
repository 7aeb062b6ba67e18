#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/core/status.hpp"

namespace firmtouch::fuzz {

/// A small asset that holds every section type of the format, and one that no reader knows: a mesh
/// with 16-bit indices and a distance map, the same with 32-bit ones, an unsigned mesh, an open curve and a closed one
/// with a dropped row.
std::vector<uint8_t> make_victim();

/// What a controller does with an asset: opens it, and where nothing is refused asks every query,
/// at points that include NaN and the limits, with small and large budgets. Every section is copied
/// to its own allocation first, so that the address sanitizer sees a read beyond it. Result: the
/// first refusal, or a pass; a failed check of the harness where an answer is out of range, not
/// finite or over its budget. `only`: the asset that is asked, nullptr for all; none shares a byte
/// with another.
core::Verdict feel(const std::vector<uint8_t>& file, const char* only = nullptr);

}  // namespace firmtouch::fuzz
