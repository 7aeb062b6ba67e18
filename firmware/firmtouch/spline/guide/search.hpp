#pragma once
// The search for the point of a guide that costs least, for .cpp files of this module only.
#include "firmtouch/spline/guide/nodes.hpp"

namespace firmtouch::spline {

/// Branch and bound over the parts of a guide, by distance and penalty together.
class GuideSearch : public Account {
 public:
  using Range = GuideNodes::Range;

  GuideSearch(GuideNodes& nodes, uint32_t budget, Best& best)
      : Account(budget, kVisitWork), nodes_(nodes), best_(best) {}

  /// From a leaf that may be near up the tree, as far as a node `end` above it.
  void run(uint32_t leaf, const Range& range, uint32_t end) {
    Entry first{leaf, 0.0f, range};
    if (!solve(first) || !drain()) return stop();
    for (uint32_t node = leaf; node != end && best_.limit_m > 0.0f; node = nodes_.parent_of(node)) {
      if (work_.left == 0) return stop();
      visit(nodes_.sibling_of(node), 0.0f);
      if (!drain()) return stop();
    }
    is_complete_ = true;
  }

  float pending_m(float outside_m) const { return min_pending_m(stack_, count_, outside_m); }

 private:
  static constexpr uint32_t kVisitWork = 2;
  struct Entry {
    uint32_t node;
    float lower_m;
    Range range;  // of a leaf
  };
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), and two.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 3;

  void put(const Entry& entry) {
    if (count_ < kCapacity)
      stack_[count_++] = entry;
    else
      lose(entry.lower_m);
  }

  // Reads a node and keeps it where it may hold something nearer.
  void visit(uint32_t node, float above_m) {
    --work_.left;
    Entry& entry = stack_[count_ < kCapacity ? count_ : kCapacity];
    entry.node = node;
    const float own_m = nodes_.bound_m(node, entry.range);
    entry.lower_m = own_m < above_m ? above_m : own_m;
    if (!(entry.lower_m < best_.limit_m)) return;
    if (count_ < kCapacity)
      ++count_;
    else
      lose(entry.lower_m);
  }

  // False: the budget ended, and what is left stands on the stack.
  bool drain() {
    while (count_ > 0) {
      Entry& entry = stack_[--count_];
      if (entry.lower_m >= best_.limit_m) continue;
      if (nodes_.is_leaf(entry.node)) {
        if (!solve(entry)) return false;
      } else if (work_.left < 2) {
        ++count_;
        return false;
      } else {
        open(entry);
      }
    }
    return true;
  }

  // The nearer child comes up first.
  void open(const Entry& entry) {
    const float lower_m = entry.lower_m;
    const uint32_t before = count_;
    uint32_t low, high;
    nodes_.children(entry.node, low, high);
    visit(low, lower_m);
    visit(high, lower_m);
    if (count_ == before + 2 && stack_[before].lower_m < stack_[before + 1].lower_m) {
      const Entry first = stack_[before];
      stack_[before] = stack_[before + 1];
      stack_[before + 1] = first;
    }
  }

  bool solve(Entry& entry) {
    Half<Range> halves[2];
    const uint32_t node = entry.node;
    const float lower_m = entry.lower_m;
    const Outcome outcome = nodes_.solve(node, entry.range, lower_m, work_, best_, halves);
    if (outcome == Outcome::kClosed) return true;
    if (outcome == Outcome::kStopped) put(Entry(entry));
    if (outcome == Outcome::kLost) lose(lower_m);
    if (outcome == Outcome::kSplit) {
      const uint32_t near = halves[1].lower_m < halves[0].lower_m ? 1 : 0;
      put({node, halves[1 - near].lower_m, halves[1 - near].range});
      put({node, halves[near].lower_m, halves[near].range});
    }
    return outcome != Outcome::kStopped;
  }

  GuideNodes& nodes_;
  Best& best_;
  uint32_t count_ = 0;
  Entry stack_[kCapacity + 1];
};

}  // namespace firmtouch::spline
