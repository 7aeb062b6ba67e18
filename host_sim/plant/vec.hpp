#pragma once
#include "surface/point.hpp"

// Double precision: this is the physics around the controller, not the controller.
namespace firmtouch::host_sim {

using Vec = tools::Point;

inline Vec wide(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
inline double norm(Vec a) { return length(a); }
inline Vec unit(Vec a) {
  const double size = norm(a);
  return size > 0 ? a * (1 / size) : Vec{0, 0, 1};
}

}  // namespace firmtouch::host_sim
