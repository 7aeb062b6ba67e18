#pragma once
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::lab {

/// A binary tree of k-DOPs over triangles, one a leaf, in double: the baseline of Platis &
/// Theoharis 2003, table 4.
///
/// Split at the mean of the triangles' centres along the longest axis.
/// Source: Klosowski et al. 1998, "Efficient collision detection using bounding volume hierarchies
/// of k-DOPs".
class KdopTree {
 public:
  /// How a segment is held against a node: by overlap of their k-DOPs, as that code did it for
  /// triangles (what the published figures match), or clipped by the node's slabs.
  enum class Test { kIntervals, kClip };

  /// `k`: 6, 14, 18 or 26.
  KdopTree(const tools::Surface& surface, uint32_t k);

  /// Crossings of the segment; adds the nodes looked at to `visits`.
  uint32_t crossings(tools::Point a, tools::Point b, Test test, uint64_t& visits) const;
  uint64_t bytes() const { return nodes_.size() * sizeof(Node) + ranges_.size() * sizeof(Range); }

 private:
  struct Range {
    float low, high;
  };
  struct Node {
    uint32_t left = 0;      // its sibling follows; 0: a leaf
    uint32_t triangle = 0;  // of a leaf
  };
  void fit(uint32_t node, const uint32_t* first, const uint32_t* end);
  uint32_t split(uint32_t* first, uint32_t* end) const;
  bool clips(uint32_t node, const double* from, const double* rate) const;

  const tools::Surface& surface_;
  uint32_t axes_;  // half of k
  std::vector<Node> nodes_;
  std::vector<Range> ranges_;  // axes_ a node
  std::vector<tools::Point> centres_;
};

/// Whether the segment crosses the triangle, in double.
/// Source: Moeller & Trumbore 1997.
bool crosses(const tools::Surface& surface, uint32_t triangle, tools::Point a, tools::Point b,
             double& t);

}  // namespace firmtouch::lab
