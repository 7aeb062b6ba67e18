#pragma once
#include <algorithm>
#include <cstdint>

namespace firmtouch::tools {

/// How many of `count` nodes of a binary tree whose levels are filled from the left stand below its
/// root's first child.
inline uint32_t first_size(uint32_t count) {
  uint32_t level = 1;  // nodes of the last level, were it full
  while (2 * level <= count) level *= 2;
  const uint32_t last = count - (level - 1), half = level / 2;
  return count == 1 ? 0 : (half - 1) + std::min(last, half);
}

}  // namespace firmtouch::tools
