#pragma once
// Branch and bound over the parts of curves, for .cpp files of this room only.
#include "firmtouch/spline/curve_proof.hpp"
#include "firmtouch/spline/curve_tree.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

/// Leaves next to each other along the curve, outside which everything is at least so far away.
struct LeafFence {
  uint32_t first, last;
  float distance_m;
};

template <bool kFlat>
class CurveSearch {
 public:
  using Tree = CurveTree<kFlat>;
  using Range = CurveRange;

  CurveSearch(const View& model, math::Vec3 p_m, uint32_t budget, Best& best)
      : tree_(model, p_m),
        loss_m_(model.head().loss_m),
        budget_(budget == 0 ? 1 : budget),
        left_(budget_),
        best_(best) {}

  /// The leaf of a hint, from where it was left: none for a hint that is none.
  bool resume(uint32_t place, uint32_t& node, Range& range) const {
    const uint32_t leaf = place >> 16;
    if (leaf > tree_.last()) return false;
    node = tree_.node_of(leaf);
    range = tree_.range_of(node, decoded(place & 0xFFFFu, 65535));
    return true;
  }
  /// Where the nearest point will be after as much motion again, as far as its leaf and the next one of
  /// its piece reach.
  uint32_t place_after(math::Vec3 motion_m) const {
    uint32_t node = best_.node;
    float s = best_.s;
    Range range = tree_.range_of(node, 0.0f);
    if (best_bend_ > 0.0f) {
      s += dot_as<kFlat>(best_.along[0], motion_m) / best_bend_;
      const bool is_above = s > range.high;
      if (is_above || s < range.low) {
        const uint32_t order = tree_.order_of(node) + (is_above ? 1u : 0u - 1u);
        const uint32_t beside = order <= tree_.last() ? tree_.leaf_at(order) : node;
        if (tree_.piece_of(beside) == tree_.piece_of(node)) {
          node = beside;
          range = tree_.range_of(node, 0.0f);
        }
      }
    }
    return tree_.leaf_of(node) << 16 | coded((s - range.low) / (range.high - range.low), 65535);
  }
  uint32_t piece_of(uint32_t node) const { return tree_.piece_of(node); }

  /// From a leaf that may be near to those within the fence, where everything outside it is far enough
  /// away, else up the tree to the root: then a new fence is told, `margin_m` farther than the best
  /// where there is room for it.
  void run_warm(uint32_t leaf, const Range& range, float margin_m, LeafFence& fence) {
    Entry first{leaf, 0.0f, range};
    if (!solve(first) || (count_ != 0 && !drain())) return stop();
    is_complete_ = best_.limit_m <= 0.0f;
    if (is_complete_) return;
    if (best_.limit_m <= fence.distance_m && fence.last <= tree_.last())
      is_complete_ = look_within(fence, tree_.order_of(leaf));
    else
      is_complete_ = climb(leaf, margin_m, fence);
    if (!is_complete_) stop();
  }

  void run_cold(float outside_m) {
    Entry& first = stack_[0];
    first.node = 0;
    first.lower_m = outside_m;
    if (tree_.is_leaf(0)) first.range = tree_.range_of(0, tree_.see(0).share);
    count_ = 1;
    is_complete_ = drain();
  }

  bool is_complete() const { return is_complete_ && lost_m_ >= FLT_MAX; }
  uint32_t steps() const { return budget_ - left_; }

  /// Certified distance to all that was not looked at, before what float32 loses; nothing of the model
  /// is nearer than outside_m.
  float pending_m(float outside_m) const {
    float least_m = lost_m_;
    if (is_cut_) least_m = outside_m;
    for (uint32_t i = 0; i < count_; ++i)
      if (stack_[i].lower_m < least_m) least_m = stack_[i].lower_m;
    return least_m;
  }

 private:
  static constexpr uint32_t kMostTurns = 5;
  static constexpr uint32_t kBeside = 4;  // a fence reaches at most so many leaves to either side
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), and two.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 3;
  static constexpr uint32_t kMostPassed = 24;
  static constexpr uint32_t kMostOpened = 4;

  struct Entry {
    uint32_t node;
    float lower_m;
    Range range;  // of a leaf
  };
  struct Passed {
    uint32_t node;
    float lower_m;
  };

  void stop() { is_cut_ = true; }

  bool look_within(const LeafFence& fence, uint32_t but) {
    for (uint32_t order = fence.first; order <= fence.last; ++order) {
      if (order == but) continue;
      if (left_ == 0) return false;
      --left_;
      const uint32_t leaf = tree_.leaf_at(order);
      const typename Tree::Seen seen = tree_.see(leaf);
      if (seen.lower_m >= best_.limit_m) continue;
      Entry& entry = stack_[0];
      entry.node = leaf;
      entry.lower_m = seen.lower_m;
      entry.range = tree_.range_of(leaf, seen.share);
      count_ = 1;
      if (!drain()) return false;
    }
    return true;
  }

  bool climb(uint32_t leaf, float margin_m, LeafFence& fence) {
    reach_m_ = best_.limit_m + margin_m;
    around_m_ = lost_m_ < FLT_MAX ? 0.0f : reach_m_;
    for (uint32_t node = leaf; node != 0;) {
      if (left_ == 0) return false;
      visit(sibling_of(node), 0.0f);
      node = parent_of(node);
      if (count_ != 0 && !drain()) return false;
    }
    if (leaf != best_.node) pass(leaf, 0.0f);
    fence_about(tree_.order_of(best_.node), fence);
    return true;
  }

  // Of what was passed over, the leaves beside the nearest point stand within; of the rest is known how
  // far it is. A part that is more than that is opened, and some of those farther along the curve: their
  // bounds were only as good as the search needed.
  void fence_about(uint32_t order, LeafFence& fence) {
    const uint32_t low = order > kBeside ? order - kBeside : 0, high = order + kBeside;
    fence.first = fence.last = order;
    uint32_t opened = 0;
    for (uint32_t i = 0; i < passed_count_; ++i) {
      const Passed passed = passed_[i];
      const uint32_t first = tree_.order_of(tree_.first_leaf(passed.node));
      const uint32_t last = tree_.order_of(tree_.last_leaf(passed.node));
      if (first >= low && last <= high) {
        if (first < fence.first) fence.first = first;
        if (last > fence.last) fence.last = last;
        continue;
      }
      const bool is_outside = first > high || last < low;
      const bool is_kept = is_outside && (tree_.is_leaf(passed.node) || opened++ >= kMostOpened);
      if (is_kept || left_ < 2) {
        if (passed.lower_m < around_m_) around_m_ = passed.lower_m;
      } else {
        left_ -= 2;
        pass_child(first_child(passed.node), passed.lower_m);
        pass_child(first_child(passed.node) + 1, passed.lower_m);
      }
    }
    fence.distance_m = around_m_ * (1.0f - 0x1p-22f);
  }
  void pass_child(uint32_t node, float above_m) {
    const float lower_m = tree_.see(node).lower_m;
    pass(node, lower_m > above_m ? lower_m : above_m);
  }
  // A part that need not be looked at, kept where it is within the reach of a new fence.
  void pass(uint32_t node, float lower_m) {
    if (lower_m >= reach_m_) return;
    if (passed_count_ < kMostPassed)
      passed_[passed_count_++] = {node, lower_m};
    else if (lower_m < around_m_)
      around_m_ = lower_m;
  }

  void put(uint32_t node, float lower_m, const Range& range) {
    if (count_ < kCapacity)
      stack_[count_++] = {node, lower_m, range};
    else
      lose(lower_m);
  }
  void lose(float lower_m) {
    if (lower_m < lost_m_) lost_m_ = lower_m;
    around_m_ = 0.0f;
  }

  // Reads a node and keeps it where it may hold something nearer.
  void visit(uint32_t node, float above_m) {
    --left_;
    const typename Tree::Seen seen = tree_.see(node);
    const float lower_m = seen.lower_m > above_m ? seen.lower_m : above_m;
    if (lower_m >= best_.limit_m) return pass(node, lower_m);
    if (count_ >= kCapacity) return lose(lower_m);
    Entry& entry = stack_[count_++];
    entry.node = node;
    entry.lower_m = lower_m;
    if (tree_.is_leaf(node)) entry.range = tree_.range_of(node, seen.share);
  }

  // False: the budget ended, and what is left stands on the stack.
  bool drain() {
    while (count_ > 0) {
      Entry& entry = stack_[--count_];
      if (entry.lower_m >= best_.limit_m) {
        pass(entry.node, entry.lower_m);
      } else if (tree_.is_leaf(entry.node)) {
        if (!solve(entry)) return false;
      } else if (left_ < 2) {
        ++count_;
        left_ = 0;
        return false;
      } else {
        open(entry.node, entry.lower_m);
      }
    }
    return true;
  }

  // The nearer child comes up first.
  void open(uint32_t node, float lower_m) {
    const uint32_t before = count_, low = first_child(node);
    visit(low, lower_m);
    visit(low + 1, lower_m);
    if (count_ == before + 2 && stack_[before].lower_m < stack_[before + 1].lower_m) {
      const Entry first = stack_[before];
      stack_[before] = stack_[before + 1];
      stack_[before + 1] = first;
    }
  }

  bool solve(Entry& entry) {
    const uint32_t node = entry.node;
    const float lower_m = entry.lower_m;
    Range range = entry.range;
    pass(node, 0.0f);
    float middle, below_m = lower_m, above_m = lower_m;
    switch (close(node, range, middle, below_m, above_m)) {
      case Outcome::kClosed:
        return true;
      case Outcome::kStopped:
        put(node, lower_m, range);
        return false;
      case Outcome::kLost:
        lose(lower_m);
        return true;
      case Outcome::kSplit:
        break;
    }
    const Range below{range.low, middle, 0.5f * (range.low + middle)};
    const Range above{middle, range.high, 0.5f * (middle + range.high)};
    const bool is_below_first = above_m >= below_m;
    if (is_below_first) put(node, above_m, above);
    put(node, below_m, below);
    if (!is_below_first) put(node, above_m, above);
    return true;
  }

  /// Evaluates points of the range until what is left of it is beyond the best's limit (kClosed), or in
  /// two halves with bounds of their own (kSplit); where float32 has no point between the ends it is
  /// given up (kLost).
  Outcome close(uint32_t node, Range& range, float& middle, float& below_m, float& above_m) {
    const Piece& piece = tree_.piece(tree_.piece_of(node));
    const math::Vec3 q_m = tree_.query_from(piece);
    float s = range.start;
    for (uint32_t turn = 0; turn < kMostTurns; ++turn) {
      if (left_ == 0) {
        range.start = s;
        return Outcome::kStopped;
      }
      --left_;
      ++best_.evaluations;
      CurvePoint at;
      evaluate_as<kFlat>(piece, tree_.coefficients(), s, at);
      const math::Vec3 r_m = at.x - q_m;
      const float distance2_m2 = tree_.distance2(r_m), speed2 = dot_as<kFlat>(at.d1, at.d1);
      const float slope = dot_as<kFlat>(r_m, at.d1), bend = speed2 + dot_as<kFlat>(r_m, at.d2);
      if (best_.take(distance2_m2)) {
        best_.node = node;
        best_.s = s;
        best_.x = at.x;
        best_.along[0] = at.d1;
        best_bend_ = bend;
      }
      // Where Newton's step leads within the range, and what it would gain there is needed, no proof can
      // hold yet.
      float next = bend > 0.0f ? s - slope / bend : slope > 0.0f ? range.low : range.high;
      if (next > range.low && next < range.high && turn + 1 < kMostTurns &&
          !best_.seems_beyond(distance2_m2 + slope * (next - s))) {
        s = next;
        continue;
      }
      const Expansion f =
          expand<kFlat>(distance2_m2, bend, speed2, at.d2, tree_.bend_of(node), loss_m_);
      const float below2 = f.least2(-slope, s - range.low),
                  above2 = f.least2(slope, range.high - s);
      const bool is_below_done = best_.is_beyond(below2), is_above_done = best_.is_beyond(above2);
      if (is_below_done && is_above_done) return Outcome::kClosed;
      if (is_below_done) range.low = s;
      if (is_above_done) range.high = s;
      if (!(next > range.low)) next = range.low;
      if (!(next < range.high)) next = range.high;
      const float step = next - s;
      if (!(step > 0.0f || step < 0.0f)) {  // Newton goes no further, yet a side is not proven
        if (!is_below_done && !is_above_done) {
          middle = s;
          raise(below_m, below2);
          raise(above_m, above2);
          return Outcome::kSplit;
        }
        next = 0.5f * (range.low + range.high);
      }
      s = next;
    }
    middle = 0.5f * (range.low + range.high);
    return middle > range.low && middle < range.high ? Outcome::kSplit : Outcome::kLost;
  }

  static void raise(float& lower_m, float lower2_m2) {
    if (!(lower2_m2 > 0.0f)) return;
    const float own_m = math::square_root(lower2_m2) * (1.0f - 0x1p-21f);
    if (own_m > lower_m) lower_m = own_m;
  }

  Tree tree_;
  float loss_m_;
  uint32_t budget_, left_;
  Best& best_;
  float best_bend_ = 0.0f;
  float lost_m_ = FLT_MAX;  // bound of what the stack had no room for
  bool is_complete_ = false;
  bool is_cut_ = false;  // parts of the tree were not reached at all
  float reach_m_ = 0.0f, around_m_ = 0.0f;
  uint32_t passed_count_ = 0, count_ = 0;
  Passed passed_[kMostPassed];
  Entry stack_[kCapacity];
};

}  // namespace firmtouch::spline
