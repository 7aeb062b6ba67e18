#include "surface/extent.hpp"

#include <algorithm>

namespace firmtouch::tools {

void Extent::add(Point p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Extent extent_of(const Surface& surface) {
  Extent extent;
  for (const Face& face : surface.faces)
    for (const uint32_t v : face) extent.add(to_point(surface.vertices[v]));
  return extent;
}

}  // namespace firmtouch::tools
