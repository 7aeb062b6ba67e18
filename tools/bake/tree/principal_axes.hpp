#pragma once
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// Three unit vectors at right angles, right-handed.
struct Frame {
  Point axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// A point's places along the axes.
inline Point along(const Frame& frame, Point p) {
  return {dot(frame.axis[0], p), dot(frame.axis[1], p), dot(frame.axis[2], p)};
}

/// The principal axes of points, the widest first; by Jacobi's rotations, of + - * / and square
/// roots only, so the same on every machine.
Frame principal_axes(const std::vector<Point>& points);

}  // namespace firmtouch::tools
