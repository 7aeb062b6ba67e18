#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Closest point of a triangle to a point, in double. `part`: 0 face, 1 to 3 the edge from corner
/// part - 1 to the next, 4 to 6 corner part - 4.
struct Foot {
  Point at;
  double distance2 = 0;
  uint32_t part = 0;
};

/// Source: Ericson 2005, 5.1.5, with the longest edge first (mesh/triangle.hpp says why).
Foot foot_on(Point p, const std::array<Point, 3>& triangle);

/// On which side of a closed surface a point is, by the angle-weighted pseudonormal of the feature
/// that its closest point lies on.
/// Source: Baerentzen & Aanaes 2005, section 3.
class SideTeller {
 public:
  /// Pre: every edge has two faces, wound alike.
  explicit SideTeller(const Surface& surface);

  /// -1 inside, +1 outside; on the surface +1.
  int side_of(Point p, uint32_t face, const Foot& foot) const;

 private:
  const Surface& surface_;
  std::vector<Point> face_normal_, vertex_normal_;
  std::vector<uint32_t> across_;  // of each half-edge: the face on its other side
};

}  // namespace firmtouch::tools
