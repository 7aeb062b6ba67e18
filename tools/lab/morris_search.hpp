#pragma once
#include <deque>
#include <vector>

#include "field/triangle_tree.hpp"

namespace firmtouch::tools {

/// The published search for a list of points, for comparison: a list of boxes to look at, lower and
/// upper bounds by nearest and farthest corner, the next point's list seeded with the box `ascend`
/// levels above the last nearest triangle. Two things differ from the print, which gives wrong
/// answers (tests/lab/morris_host_test.cpp): distances to planes are squared before they are
/// summed, and the bounds begin anew with each point. Two more change no answer: the subtree of the
/// seed is emptied before the root is queued, not beside it, and a leaf lowers the upper bound or
/// leaves it.
/// Source: Morris 2006, section 3.3.
class MorrisSearch {
 public:
  struct Options {
    uint32_t ascend = 2;      // TREE_ASCEND_N; levels
    bool is_seeded = true;    // false: each point from the root alone
    bool depth_first = true;  // else breadth-first
  };

  /// Pre: the tree has one triangle a leaf.
  MorrisSearch(const TriangleTree& tree, const Options& options);

  uint32_t nearest(const std::array<float, 3>& p);
  uint64_t boxes_read() const { return boxes_read_; }

 private:
  void look_at(uint32_t node, const std::array<float, 3>& p);

  const TriangleTree& tree_;
  Options options_;
  std::vector<uint32_t> parents_;
  std::deque<uint32_t> to_descend_;
  float least2_ = 0, upper2_ = 0;
  uint32_t best_ = 0, best_node_ = kNoFace;
  uint64_t boxes_read_ = 0;
};

}  // namespace firmtouch::tools
