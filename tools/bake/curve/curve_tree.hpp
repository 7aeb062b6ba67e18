#pragma once
#include <vector>

#include "firmtouch/curve/layout.hpp"

namespace firmtouch::tools {

/// The implicit balanced k-d tree over the samples of a curve, split across the widest axis by
/// (coordinate, sample): a total order, so the same tree on every machine.
/// Cost: O(n log n), about 2 s for 2,000,000 samples.
std::vector<uint32_t> build_curve_tree(const std::vector<curve::Sample>& samples);

}  // namespace firmtouch::tools
