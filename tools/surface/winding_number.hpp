#pragma once
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// How often a closed surface winds around a point: 1 inside an outward solid, 0 outside; where a
/// surface crosses itself or shells lie in one another also other numbers. Counts, with their sign,
/// the triangles that a ray from the point crosses. Vertices are projected along the ray onto a
/// grid, where sides of edges are exact, and ties go one way, so that a ray through an edge or a
/// vertex is still counted once.
/// Source: Edelsbrunner & Muecke 1990, "Simulation of simplicity".
class WindingNumber {
 public:
  /// `chosen`: which faces count; empty: all. They must close: every edge as often in one direction
  /// as in the other.
  WindingNumber(const Surface& surface, const std::vector<bool>& chosen);

  /// Exact except for points nearer to a triangle than 1e-13 of the surface's size.
  int at(Point p) const;

 private:
  struct Triangle {
    uint32_t corner[3];
  };

  double steps_per_m_;
  std::vector<Point> projected_;  // steps across the ray, z as it was
  std::vector<Triangle> triangles_;
  BoxTree tree_;
  mutable std::vector<uint32_t> found_;
};

}  // namespace firmtouch::tools
