#pragma once
// What a search passes over becomes the next query's safe subtree, for .cpp files of this module
// only.
#include "firmtouch/spline/curve/tree.hpp"

namespace firmtouch::spline {

/// Leaves next to each other along the curve, first to last; without one where last < first.
struct LeafRow {
  uint32_t first, last;
  bool holds(uint32_t from, uint32_t to) const { return first <= from && to <= last; }
};
/// Outside these leaves everything is at least so far away.
struct LeafSafeSubtree {
  LeafRow row;
  float distance_m;
};

constexpr uint32_t kBeside = 4;  // a safe subtree reaches at most so many leaves to either side

/// Parts that need not be looked at, each with a lower bound of its distance.
class PassedNodes {
 public:
  using Tree = CurveTree;
  PassedNodes() {}  // by hand: else all is cleared

  /// Parts that are farther than the reach are outside every safe subtree.
  void begin(float reach_m) { reach_m_ = around_m_ = reach_m; }
  float reach_m() const { return reach_m_; }
  void pass(uint32_t node, float lower_m) {
    if (lower_m >= reach_m_) return;
    if (count_ < kMax)
      passed_[count_++] = {node, lower_m};
    else if (lower_m < around_m_)
      around_m_ = lower_m;
  }
  /// Something is this far away, and no leaf says where.
  void pass(float lower_m) {
    if (lower_m < around_m_) around_m_ = lower_m;
  }

  /// What was passed beside a leaf lies within the safe subtree, with the row about it; of the rest
  /// is known how far it is. A part that is more than that is opened, and some of those farther
  /// along the curve where few steps were taken: their bounds were only as good as the search
  /// needed.
  LeafSafeSubtree safe_subtree_about(const Tree& tree, uint32_t leaf, LeafRow row, uint32_t& left) {
    uint32_t low = leaf > kBeside ? leaf - kBeside : 0, high = leaf + kBeside;
    if (row.first < low) low = row.first;
    if (row.last > high) high = row.last;
    for (uint32_t i = 0; i < count_; ++i) {
      const Passed passed = passed_[i];
      const CurveLevels::Leaves under = tree.below(passed.node);
      const uint32_t last = under.end - 1;
      if (under.first >= low && last <= high) {
        if (under.first < row.first) row.first = under.first;
        if (last > row.last) row.last = last;
        continue;
      }
      const bool is_outside = under.first > high || last < low;
      if (is_outside || left < 2) {
        pass(passed.lower_m);
      } else {
        left -= 2;
        pass_child(tree, 2 * passed.node, passed.lower_m);
        pass_child(tree, 2 * passed.node + 1, passed.lower_m);
      }
    }
    return {row, around_m_ * (1.0f - 0x1p-22f)};
  }

 private:
  static constexpr uint32_t kMax = 8;
  struct Passed {
    uint32_t node;
    float lower_m;
  };

  void pass_child(const Tree& tree, uint32_t node, float above_m) {
    if (tree.below(node).first > tree.last()) return;
    const float lower_m = tree.see(node).lower_m;
    pass(node, lower_m > above_m ? lower_m : above_m);
  }

  float reach_m_ = 0.0f, around_m_ = 0.0f;
  uint32_t count_ = 0;
  Passed passed_[kMax];
};

}  // namespace firmtouch::spline
