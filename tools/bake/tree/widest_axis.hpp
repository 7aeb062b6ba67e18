#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace firmtouch::tools {

/// The axis along which items begin to end are spread most; the first of equal ones.
/// `place_of(item)`: an array of three numbers.
template <class Items, class PlaceOf>
uint32_t widest_axis(const Items& items, uint32_t begin, uint32_t end, const PlaceOf& place_of) {
  auto low = place_of(items[begin]), high = low;
  for (uint32_t i = begin + 1; i < end; ++i) {
    const auto& place = place_of(items[i]);
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
    }
  }
  size_t widest = 0;
  for (size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  return static_cast<uint32_t>(widest);
}

}  // namespace firmtouch::tools
