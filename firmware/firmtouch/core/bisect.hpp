#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// The last index below `count` for which `holds`, which holds for none behind one for which it
/// does not. Pre: count < 2^31. Bounds: log2(count) calls. Result: 0 where it holds for none.
template <class Holds>
uint32_t last_that(uint32_t count, const Holds& holds) {
  uint32_t first = 0, last = count;
  while (last - first > 1) {
    const uint32_t middle = (first + last) / 2;
    if (holds(middle))
      first = middle;
    else
      last = middle;
  }
  return first;
}

}  // namespace firmtouch::core
