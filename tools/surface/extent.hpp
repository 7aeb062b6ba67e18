#pragma once
#include <cmath>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The box about points. Of none its low corner is at infinity.
struct Extent {
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  void add(Point p);
};

/// Of the faces: a vertex that none has does not count.
Extent extent_of(const Surface& surface);

}  // namespace firmtouch::tools
