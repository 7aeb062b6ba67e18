#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

constexpr uint32_t kNoFace = 0xFFFFFFFFu;

struct FloatBox {
  std::array<float, 3> low, high;
};

/// The triangles of a surface in float32 about the middle of its box, in a binary tree of boxes:
/// for dense queries on a desktop. Coordinates err by 2^-25 of the extent.
class TriangleTree {
 public:
  /// Bounds: O(n log^2 n), no recursion. The same tree on every machine.
  explicit TriangleTree(const Surface& surface, uint32_t leaf_triangles = 4);

  struct Node {
    FloatBox box;
    uint32_t first;  // of its triangles, or of its two children where count is 0
    uint32_t count;
  };
  /// A triangle as the queries take it: corner, corner, corner.
  struct Corners {
    float at[9];
  };

  /// Eight words, of which a box or a disk fills the first.
  struct Row {
    alignas(32) float word[8];
  };

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Corners>& triangles() const { return triangles_; }  // in leaf order
  /// Of the same: low x y z, high x y z.
  const std::vector<Row>& boxes() const { return boxes_; }
  /// A disk in the triangle's plane that holds it: centre, unit normal, radius. Where the triangle
  /// has no plane worth the name the normal is 0, and the disk a sphere.
  const std::vector<Row>& disks() const { return disks_; }
  uint32_t face_of(uint32_t triangle) const { return faces_[triangle]; }
  uint32_t triangle_of(uint32_t face) const { return places_[face]; }
  /// Frame of the floats.
  Point origin_m() const { return origin_m_; }
  std::array<float, 3> local(Point p_m) const {
    return {static_cast<float>(p_m.x - origin_m_.x), static_cast<float>(p_m.y - origin_m_.y),
            static_cast<float>(p_m.z - origin_m_.z)};
  }
  /// What rounding may do to a distance found here: taken off where something is left out.
  float slack_m() const { return slack_m_; }

  /// The triangle nearest to `p` (local). `seed`: one that is probably near, or kNoFace.
  /// Source: Morris 2006, 3.3: the triangle that was nearest to the point before is the first
  ///         upper bound.
  uint32_t nearest(const std::array<float, 3>& p, uint32_t seed) const;

  float distance2(const std::array<float, 3>& p, uint32_t triangle) const;

 private:
  Point origin_m_;
  float slack_m_ = 0;
  std::vector<Node> nodes_;
  std::vector<Corners> triangles_;
  std::vector<Row> boxes_, disks_;
  std::vector<uint32_t> faces_, places_;
};

/// Squared distance from a box to a box or a point, axis by axis.
inline float gap2(const float* a_low, const float* a_high, const std::array<float, 3>& low,
                  const std::array<float, 3>& high) {
  float sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const float below = a_low[k] - high[k], above = low[k] - a_high[k];
    const float gap = below > above ? below : above;
    if (gap > 0) sum += gap * gap;
  }
  return sum;
}
inline float gap2(const FloatBox& a, const std::array<float, 3>& low,
                  const std::array<float, 3>& high) {
  return gap2(a.low.data(), a.high.data(), low, high);
}

}  // namespace firmtouch::tools
