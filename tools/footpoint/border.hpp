#pragma once
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// An edge of a patch, and where it runs through the surface's parameters.
struct Border {
  BezierCurve curve;  // t from 0 to 1
  double u0, v0, u1, v1;
};

struct Corner {
  Point at;
  int piece;
  double u, v;
};

/// The edges of patches over which no other patch goes on smoothly, and the corners where they end or
/// turn, edges that are a single point among them.
void find_borders(const std::vector<BezierPatch>& patches, double extent_m,
                  std::vector<Border>& borders, std::vector<Corner>& corners);

}  // namespace firmtouch::tools
