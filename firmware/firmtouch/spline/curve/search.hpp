#pragma once
// Branch and bound over the parts of curves, for .cpp files of this module only.
#include "firmtouch/spline/curve/expansion.hpp"
#include "firmtouch/spline/curve/safe_subtree.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

class CurveSearch : public Account {
 public:
  using Tree = CurveTree;
  using Range = CurveRange;

  CurveSearch(const View& model, math::Vec3 p_m, uint32_t budget, Best& best)
      : Account(budget, 1), tree_(model, p_m), loss_m_(model.head().loss_m), best_(best) {}

  /// The piece of a hint, and where on it: false for a hint that is none.
  bool resume(uint32_t foot, uint32_t& piece, float& s) const {
    piece = foot >> 16;
    s = static_cast<float>(foot & 0xFFFFu) * kFootStep - 1.0f;
    return piece < tree_.piece_count();
  }
  /// Where the nearest point will be after as much motion again, no farther on than a leaf and its
  /// piece.
  uint32_t foot_after(math::Vec3 motion_m) const {
    const uint32_t piece = best_.node;
    float s = best_.s;
    if (best_bend_ > 0.0f) {
      const float wide = tree_.width_of(piece);
      const float step = dot(best_.along[0], motion_m) / best_bend_;
      s += step < wide ? (step > -wide ? step : -wide) : wide;
    }
    return piece << 16 | coded(0.5f * s + 0.5f, 65535);
  }

  /// From a place that may be near to the leaves within the safe subtree, where everything outside
  /// it is far enough away, else up the tree to the root: then a new safe subtree is stored,
  /// `margin_m` farther than the best where there is room for it.
  void run_warm(uint32_t piece, float s, float margin_m, LeafSafeSubtree& safe_subtree) {
    const uint32_t leaf = tree_.leaf_at(piece, s);
    LeafRow row = safe_subtree.row;
    if (!(row.holds(leaf, leaf) && row.last <= tree_.last()))
      row = {leaf > kBeside ? leaf - kBeside : 0, leaf + kBeside};
    const uint32_t first = tree_.first_of(piece), last = tree_.last_of(piece);
    row_ = {row.first > first ? row.first : first, row.last < last ? row.last : last};
    const float wide = tree_.width_of(piece);
    Entry all{tree_.node_of(leaf),
              0.0f,
              {tree_.end_of(piece, row_.first, wide), tree_.end_of(piece, row_.last + 1, wide), s}};
    if (!solve(all, true) || (count_ != 0 && !drain())) return stop();
    is_complete_ = best_.limit_m <= 0.0f;
    if (is_complete_) return;
    if (best_.limit_m <= safe_subtree.distance_m && safe_subtree.row.last <= tree_.last())
      is_complete_ = look_within(safe_subtree.row);
    else
      is_complete_ = look_everywhere(margin_m, safe_subtree);
    if (!is_complete_) stop();
  }

  void run_cold(float outside_m) {
    put(1, outside_m);
    if (tree_.is_leaf(1)) stack_[0].range = tree_.range_of(0, tree_.see(1).share);
    is_complete_ = drain();
  }

  float pending_m(float outside_m) const { return min_pending_m(stack_, count_, outside_m); }

 private:
  static constexpr uint32_t kMaxTurns = 5;
  static constexpr uint32_t kEvaluationWork = 3;       // beside the visit
  static constexpr float kFootStep = 2.0f / 65535.0f;  // 65,535 of them are 2 in float32 as well
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), and two.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 3;
  static constexpr uint32_t kStep = 2;  // levels
  static constexpr uint32_t kManySteps = 40;

  struct Entry {
    uint32_t node;
    float lower_m;
    Range range;  // of a leaf
  };

  bool look_within(const LeafRow& row) {
    if (row.last > closed_.last &&
        !look_at(row.first > closed_.last ? row.first : closed_.last + 1, row.last))
      return false;
    return row.first >= closed_.first ||
           look_at(row.first, row.last < closed_.first ? row.last : closed_.first - 1);
  }
  bool look_at(uint32_t first, uint32_t last) {
    const uint32_t count = last - first + 1;
    if (work_.left < count) return false;
    scan(tree_.node_of(first), tree_.node_of(first) + count);
    return drain();
  }

  bool look_everywhere(float margin_m, LeafSafeSubtree& safe_subtree) {
    passed_.begin(best_.limit_m + margin_m);
    if (lost_m_ < FLT_MAX) passed_.pass(0.0f);
    if (!tree_.is_leaf(1)) {
      put(1, 0.0f);
      if (!drain()) return false;
    }
    if (steps() > kManySteps) {  // the next query makes one
      safe_subtree = {{1, 0}, 0.0f};
      return true;
    }
    const uint32_t leaf = tree_.leaf_at(best_.node, best_.s);
    LeafRow row{leaf, leaf};
    if (closed_.holds(leaf, leaf))
      row = closed_;
    else if (closed_.first <= closed_.last)
      passed_.pass(raised(0.0f, closed2_m2_));
    safe_subtree = passed_.safe_subtree_about(tree_, leaf, row, work_.left);
    return true;
  }

  void put(const Entry& entry) {
    if (count_ < kCapacity)
      stack_[count_++] = entry;
    else
      lose(entry.lower_m);
  }
  void lose(float lower_m) {
    Account::lose(lower_m);
    passed_.pass(0.0f);
  }

  void put(uint32_t node, float lower_m) {
    Entry& entry = stack_[count_++];
    entry.node = node;
    entry.lower_m = lower_m;
  }

  // Reads the nodes of a level from one to before another, except closed ones, and keeps those
  // that may hold something nearer.
  void scan(uint32_t node, uint32_t end) {
    const CurveLevels& levels = tree_.levels();
    const uint32_t below = levels.levels_below(node), first = levels.first_node();
    const uint32_t there = ((first + tree_.last()) >> below) + 1;
    if (there < end) end = there;
    const uint32_t closed = (first + closed_.first + (1u << below) - 1) >> below;
    const uint32_t closed_end = (first + closed_.last + 1) >> below;
    base_ = count_;
    if (closed_end <= node || closed >= end || closed >= closed_end) return read(node, end, below);
    if (node < closed) read(node, closed, below);
    if (closed_end < end) read(closed_end, end, below);
  }
  void read(uint32_t node, uint32_t end, uint32_t below) {
    tree_.is_flat() ? read_as<true>(node, end, below) : read_as<false>(node, end, below);
  }
  template <bool kIsFlat>
  void read_as(uint32_t node, uint32_t end, uint32_t below) {
    const float limit_m = best_.limit_m, reach_m = passed_.reach_m();
    work_.left -= end - node;
    const Tree tree = tree_;  // of its own: nothing that is kept changes it
    Tree::Chords<kIsFlat> chords(tree, node, below);
    for (; node < end; ++node) {
      const Tree::Seen seen = chords.next();
      if (seen.lower_m < limit_m)
        keep(node, seen.lower_m, seen.share);
      else if (seen.lower_m < reach_m)
        passed_.pass(node, seen.lower_m);
    }
  }
  // The nearest of a scan comes up first.
  [[gnu::noinline]] void keep(uint32_t node, float lower_m, float share) {
    const bool is_leaf = tree_.is_leaf(node);
    if (is_leaf && tree_.piece_of(tree_.leaf_of(node)) == kNoLeaf) return;
    if (count_ >= kCapacity) return lose(lower_m);
    Entry* entry = stack_ + count_++;
    if (count_ - 1 > base_ && entry[-1].lower_m <= lower_m) {
      *entry = entry[-1];
      --entry;
    }
    entry->node = node;
    entry->lower_m = lower_m;
    if (is_leaf) entry->range = tree_.range_of(tree_.leaf_of(node), share);
  }

  // False: the budget ended, and what is left stands on the stack.
  bool drain() {
    while (count_ > 0) {
      Entry& entry = stack_[--count_];
      if (entry.lower_m >= best_.limit_m) {
        passed_.pass(entry.node, entry.lower_m);
      } else if (tree_.is_leaf(entry.node)) {
        if (!solve(entry, false)) return false;
      } else if (!open(entry.node)) {
        ++count_;
        return false;
      }
    }
    return true;
  }

  // Nodes that are most of the curve are not worth a look: from the root three levels to five, and
  // then two at a time.
  static uint32_t first_step(uint32_t levels) {
    return levels < 5 ? levels : levels == 7 ? 5 : 3 + ((levels - 3) & 1u);
  }
  // Goes down several levels at once. False: the budget does not reach.
  bool open(uint32_t node) {
    const uint32_t below = tree_.levels().levels_below(node);
    uint32_t step = node == 1 ? first_step(below) : below < kStep ? below : kStep;
    if (work_.left < 1u << step) step = 1;
    if (work_.left < 2) return false;
    scan(node << step, (node + 1) << step);
    return true;
  }

  // Evaluates points of a leaf's range until the rest of it is beyond the best's limit, else leaves
  // it in two halves with bounds of their own. Of a row of leaves, what a point does not close is
  // left except for its own leaf. False: the budget ended, and the rest stands on the stack.
  // noinline: both callers are cold beside it.
  [[gnu::noinline]] bool solve(const Entry& entry, bool is_row) {
    const uint32_t node = is_row ? 0 : entry.node;
    Entry rest = entry;
    const uint32_t on = tree_.piece_of(tree_.leaf_of(entry.node));
    const Piece& piece = tree_.piece(on);
    const math::Vec3 q_m = tree_.query_from(piece);
    float s = rest.range.start;
    for (uint32_t turn = 0; turn < kMaxTurns; ++turn) {
      if (!work_.visit()) {
        rest.range.start = s;
        put(rest);
        return false;
      }
      work_.charge(kEvaluationWork);
      ++best_.evaluations;
      const CurvePoint at = tree_.point_at(piece, s);
      const math::Vec3 r_m = at.x - q_m;
      const float distance2_m2 = dot(r_m, r_m), speed2 = dot(at.d1, at.d1);
      const float slope = dot(r_m, at.d1), bend = speed2 + dot(r_m, at.d2);
      if (best_.take(distance2_m2)) {
        best_.node = on;
        best_.s = s;
        best_.x = at.x;
        best_.along[0] = at.d1;
        best_bend_ = bend;
      }
      const float low = rest.range.low, high = rest.range.high;
      float next = bend > 0.0f ? s - slope / bend : slope > 0.0f ? low : high;
      // Where Newton's step leads within the range, and its gain there is needed, no proof can hold
      // yet.
      if (next > low && next < high && turn + 1 < kMaxTurns &&
          !best_.seems_beyond(distance2_m2 + slope * (next - s))) {
        s = next;
        continue;
      }
      const Expansion f =
          expand(at, r_m, distance2_m2, slope, speed2, bend, tree_.bend_of(on), loss_m_);
      Side below, above;
      prove(f, s, is_row, on, rest, below, above);
      is_row = false;
      if (below.is_done && above.is_done) {
        float min2_m2 = below.least2 < above.least2 ? below.least2 : above.least2;
        const float limit2_m2 = best_.limit_m * best_.limit_m;  // of what was closed before
        if (turn > 0 && limit2_m2 < min2_m2) min2_m2 = limit2_m2;
        if (node == 0)
          closed2_m2_ = min2_m2;
        else
          passed_.pass(node, raised(rest.lower_m, min2_m2));
        return true;
      }
      if (!(next > rest.range.low)) next = rest.range.low;
      if (!(next < rest.range.high)) next = rest.range.high;
      const float step = next - s;
      if (!(step > 0.0f || step < 0.0f)) {  // Newton goes no further, yet a side is not proven
        if (!below.is_done && !above.is_done) {
          halve(node, rest, s, raised(rest.lower_m, below.least2),
                raised(rest.lower_m, above.least2));
          return true;
        }
        next = 0.5f * (rest.range.low + rest.range.high);
      }
      s = next;
    }
    const float middle = 0.5f * (rest.range.low + rest.range.high);
    if (middle > rest.range.low && middle < rest.range.high)
      halve(node, rest, middle, rest.lower_m, rest.lower_m);
    else
      lose(rest.lower_m);  // float32 has no point between its ends
    return true;
  }

  // What the expansion at s proves of both sides of a range, less what it closes.
  struct Side {
    float least2;
    bool is_done;
  };
  void prove(const Expansion& f, float s, bool is_row, uint32_t on, Entry& rest, Side& below,
             Side& above) {
    Range& range = rest.range;
    below = side_of(f, -1.0f, s - range.low);
    above = side_of(f, 1.0f, range.high - s);
    if (is_row) {
      closed_ = row_;
      if (!below.is_done || !above.is_done) {
        const uint32_t leaf = tree_.leaf_at(on, s);
        const Range own = tree_.range_of(leaf, 0.0f);
        rest.node = tree_.node_of(leaf);
        if (!below.is_done) {
          closed_.first = leaf;
          range.low = own.low;
          below = side_of(f, -1.0f, s - range.low);
        }
        if (!above.is_done) {
          closed_.last = leaf;
          range.high = own.high;
          above = side_of(f, 1.0f, range.high - s);
        }
      }
    }
    if (!(below.is_done && above.is_done)) {
      if (below.is_done) range.low = s;
      if (above.is_done) range.high = s;
    }
  }
  Side side_of(const Expansion& f, float sign, float length) const {
    const float least2 = f.least2(sign, length);
    return {least2, best_.is_beyond(least2)};
  }

  // The half that is nearer comes up first.
  void halve(uint32_t node, const Entry& rest, float s, float below_m, float above_m) {
    if (node != 0) passed_.pass(node, 0.0f);
    const Range below{rest.range.low, s, 0.5f * (rest.range.low + s)};
    const Range above{s, rest.range.high, 0.5f * (s + rest.range.high)};
    const bool is_below_first = above_m >= below_m;
    if (is_below_first) put({rest.node, above_m, above});
    put({rest.node, below_m, below});
    if (!is_below_first) put({rest.node, above_m, above});
  }

  static float raised(float lower_m, float lower2_m2) {
    if (!(lower2_m2 > 0.0f)) return lower_m;
    const float own_m = math::square_root(lower2_m2) * (1.0f - 0x1p-21f);
    return own_m > lower_m ? own_m : lower_m;
  }

  Tree tree_;
  float loss_m_;
  Best& best_;  // its node: the piece it is of
  float best_bend_ = 0.0f;
  LeafRow row_{1, 0}, closed_{1, 0};
  float closed2_m2_ = 0.0f;  // of those leaves
  PassedNodes passed_;
  uint32_t count_ = 0, base_ = 0;  // of the stack, and where a scan's begin
  Entry stack_[kCapacity];
};

}  // namespace firmtouch::spline
