#pragma once
#include <cstdint>
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::bench {

/// Distance from `p` to the triangle a b c in double: the nearest of its three sides and, where the
/// foot lies inside, its plane. Holds for slivers and triangles without area.
double triangle_distance(tools::Point p, tools::Point a, tools::Point b, tools::Point c);

/// The oracle of the benches: true distances to a surface, in double, over a tree of its own that
/// shares nothing with the baker's and the firmware's.
class TrueDistance {
 public:
  explicit TrueDistance(const tools::Surface& surface);

  /// Bounds: O(log n) where the surface is near, no recursion.
  double operator()(math::Vec3 p_m) const;

 private:
  struct Node {
    tools::Box box;
    uint32_t begin, end;   // faces
    uint32_t first_child;  // 0: a leaf; the second follows the first
  };
  uint32_t split(uint32_t begin, uint32_t end, const tools::Box& box);
  void put_box(Node& node) const;

  const tools::Surface& surface_;
  std::vector<uint32_t> faces_;
  std::vector<Node> nodes_;
};

}  // namespace firmtouch::bench
