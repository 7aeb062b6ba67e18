#pragma once
// Branch and bound over the parts of surfaces, for .cpp files of this room only.
#include "firmtouch/spline/patch_bounds.hpp"
#include "firmtouch/spline/search.hpp"
#include "firmtouch/spline/surface_parts.hpp"

namespace firmtouch::spline {

/// Of a tree over pieces: outside a node, and below it in those of its 16 groups that have no bit, everything
/// is at least so far away. A group is what lies four levels below the node, or a piece above that for all of its own.
struct PieceFence {
  uint32_t node, groups;
  float distance_m;

  static uint32_t level_of(uint32_t i) { return digits_of(i + 1); }
  bool holds(uint32_t i) const {
    const uint32_t level = level_of(i), own = level_of(node);
    return level >= own && (i + 1) >> (level - own) == node + 1;
  }
  static uint32_t groups_below(uint32_t node, uint32_t i) {
    const uint32_t below = level_of(i) - level_of(node);
    const uint32_t in_level = (i + 1) - ((node + 1) << below);
    if (below >= 4) return 1u << (in_level >> (below - 4));
    const uint32_t each = 16u >> below;
    return ((1u << each) - 1u) << (in_level * each);
  }
  uint32_t groups_of(uint32_t i) const { return groups & groups_below(node, i); }
  // At most `beside`.
  uint32_t node_of(uint32_t group, uint32_t beside, uint32_t count) const {
    uint32_t i = ((node + 1) << 4 | group) - 1;
    if (i < beside) return beside;
    while (i >= count) i = parent_of(i);
    return i;
  }
  static PieceFence around(const uint16_t* marked, uint32_t count, float distance_m) {
    uint32_t node = marked[0];
    for (uint32_t k = 1; k < count; ++k)
      for (uint32_t i = marked[k]; i != node;)
        if (i > node)
          i = parent_of(i);
        else
          node = parent_of(node);
    PieceFence fence{node, 0, distance_m};
    for (uint32_t k = 0; k < count; ++k) fence.groups |= groups_below(node, marked[k]);
    return fence;
  }
};

class SurfaceSearch : public Account {
 public:
  using Range = Rectangle;

  SurfaceSearch(const View& model, math::Vec3 p_m, uint32_t budget, Best& best)
      : Account(budget), parts_(model, p_m), bounds_(model, p_m), best_(best) {}

  bool resume(const query::Hint& hint, uint32_t& leaf, Range& range) const {
    return parts_.resume(hint, leaf, range);
  }
  void leave(math::Vec3 motion_m, query::Hint& hint) const { parts_.leave(best_, motion_m, hint); }
  uint32_t piece_of(uint32_t node) const { return node >> 16; }

  /// From a leaf that may be near up the tree: where the fence is far enough away, of the rest only the groups within it,
  /// else all, and a new fence is told, `margin_m` farther than the best.
  void run_warm(uint32_t leaf, const Range& range, float margin_m, PieceFence& fence) {
    if (!solve(leaf, 0.0f, range)) return stop();
    uint32_t node = count_ == 0 ? parts_.closed_around(leaf, best_) : leaf;
    if (!drain()) return stop();
    is_complete_ = best_.limit_m <= 0.0f;
    if (is_complete_) return;
    while ((node & 0xFFFFu) != kWholePiece) {
      if (left_ == 0) return stop();
      const PatchNode part = apart(bounds_.come_near(node >> 16), node);
      descend(node ^ (was_halved_u(part) ? kNextU : kNextV), 0.0f, nullptr, false);
      if (!drain()) return stop();
      node = whole_of(node, part);
    }
    const uint32_t own = parts_.upper_of(node);
    const bool holds = best_.limit_m <= fence.distance_m && fence.holds(own);
    const float reach_m = best_.distance_m + margin_m;
    if (!holds) {
      reach_m_ = reach_m;
      mark(own);
    }
    for (uint32_t i = own; i != (holds ? fence.node : 0); i = parent_of(i)) {
      const uint32_t beside = sibling_of(i);
      if (!holds) {
        if (left_ == 0) return stop();
        visit_upper(beside, 0.0f, false);
        if (!drain()) return stop();
        continue;
      }
      for (uint32_t groups = fence.groups_of(beside); groups != 0;) {
        const uint32_t group = fence.node_of(digits_of(groups), beside, parts_.upper_count());
        groups &= ~PieceFence::groups_below(fence.node, group);
        if (left_ == 0) return stop();
        visit_upper(group, 0.0f, false);
        if (!drain()) return stop();
      }
    }
    is_complete_ = true;
    if (!holds) fence = PieceFence::around(marked_, marked_count_, reach_m * (1.0f - 0x1p-22f));
  }

  void run_cold(float outside_m) {
    is_cold_ = true;
    const uint32_t root = parts_.root();
    if (root >= kUpper)
      stack_[count_++] = Entry(root, outside_m);
    else
      visit_upper(0, outside_m, false);
    is_complete_ = drain();
  }

  float pending_m(float outside_m) const { return least_pending_m(stack_, count_, outside_m); }

 private:
  struct Halves {
    uint32_t far_half;
    float far_m;
  };
  struct Entry {
    uint32_t node;
    float lower_m;
    union {
      Range range;    // of a leaf
      Halves halves;  // of other parts
    };
    Entry() {}
    Entry(uint32_t of, float no_nearer_m) : node(of), lower_m(no_nearer_m) {}
  };
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), and three.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 4;

  static constexpr uint32_t kMostMarks = 16;

  // A node over pieces below which something may be within reach.
  void pass(uint32_t node, float lower_m) {
    if (lower_m < reach_m_) mark(parts_.upper_of(node));
  }
  void mark(uint32_t i) {
    if (i != last_marked_) mark_another(i);
  }
  [[gnu::noinline]] void mark_another(uint32_t i) {
    last_marked_ = i;
    for (uint32_t k = marked_count_; k-- > 0;)
      if (marked_[k] == i) return;
    if (marked_count_ < kMostMarks)
      marked_[marked_count_++] = static_cast<uint16_t>(i);
    else
      marked_[0] = 0;
  }

  [[gnu::noinline]] void visit_upper(uint32_t i, float above_m, bool is_beside) {
    const uint32_t node = parts_.upper(i);
    if (node < kUpper) return descend(node, above_m, nullptr, is_beside);
    --left_;
    const float own_m = bounds_.box_m(i), lower_m = own_m < above_m ? above_m : own_m;
    if (!(lower_m < best_.limit_m)) return pass(node, lower_m);
    if (count_ >= kCapacity) return lose(lower_m);
    stack_[count_].node = node;
    stack_[count_++].lower_m = lower_m;
  }

  void keep(uint32_t node, float lower_m, const PartBound& told, bool is_leaf) {
    if (count_ >= kCapacity) return lose(lower_m);
    Entry& entry = stack_[count_++];
    entry.lower_m = lower_m;
    if (is_leaf) {
      entry.node = node | kLeafMark;
      entry.range = parts_.range_of(node, told.x, told.y);
    } else {
      entry.node = node;
      entry.halves.far_half = told.far_half;
      entry.halves.far_m = told.far_m;
    }
  }

  // Reads a part of a piece, and of its halves the nearer one on and on, as far as the limit or a leaf.
  // What else may hold something nearer goes to the stack. `known`: it has been read already.
  [[gnu::noinline]] void descend(uint32_t node, float above_m, const Entry* known, bool is_beside) {
    const Piece& piece = bounds_.come_near(node >> 16);
    uint32_t u = (node >> 7) & 127u, v = node & 127u;
    uint32_t left_u = piece.level_u - digits_of(u), left_v = piece.level_v - digits_of(v);
    PartBound told{};
    bool is_known = known != nullptr;
    if (is_known) {
      told.far_half = known->halves.far_half;
      told.far_m = known->halves.far_m;
    }
    uint32_t near_node = 0;       // where the farther half is read: the nearer one is read after it
    float far_lower_m = FLT_MAX;  // of the farther half, where it is kept
    for (;;) {
      const bool next_u = left_u >= left_v;
      if (!is_known) {
        --left_;
        const bool is_leaf = left_u + left_v == 0;
        const bool is_kept = !bounds_.is_beyond(u, v, left_u, left_v, next_u, best_.limit_m, told);
        const float lower_m = math::larger(told.lower_m, above_m);
        if (near_node != 0) {
          if (is_kept) {
            far_lower_m = lower_m;
            keep(node, lower_m, told, is_leaf);
          } else {
            pass(node, lower_m);
          }
          node = near_node;
          near_node = 0;
          u = (node >> 7) & 127u, v = node & 127u;
          continue;
        }
        if (!is_kept) return pass(node, lower_m);
        if (parts_.may_be_closed(node, left_u + left_v) && parts_.is_closed(node, best_))
          return pass(node, 0.0f);
        if (is_leaf || lower_m > far_lower_m || left_ < 2 || is_beside) {
          keep(node, lower_m, told, is_leaf);
          if (lower_m > far_lower_m) order(count_ - 2);
          return;
        }
        above_m = lower_m;
      }
      is_known = false;
      const uint32_t next = next_u ? kNextU : kNextV;
      node += next_u ? u << 7 : v;
      if (next_u)
        --left_u;
      else
        --left_v;
      far_lower_m = FLT_MAX;
      if (told.far_m >= best_.limit_m) {
        pass(node, told.far_m);
        if (told.far_half == 0) node += next;
      } else if (told.far_half == 0) {
        near_node = node + next;
      } else {
        near_node = node;
        node += next;
      }
      u = (node >> 7) & 127u, v = node & 127u;
    }
  }
  void order(uint32_t before) {
    if (!(stack_[before].lower_m < stack_[before + 1].lower_m)) return;
    const Entry first = stack_[before];
    stack_[before] = stack_[before + 1];
    stack_[before + 1] = first;
  }

  // False: the budget ended, and what is left stands on the stack.
  bool drain() { return count_ == 0 || drain_all(); }
  [[gnu::noinline]] bool drain_all() {
    while (count_ > 0) {
      const Entry& entry = stack_[--count_];
      const uint32_t node = entry.node;
      const float lower_m = entry.lower_m;
      if (lower_m >= best_.limit_m) {
        pass(node, lower_m);
        continue;
      }
      if (parts_.is_closed(node & ~kLeafMark, best_)) {
        pass(node, 0.0f);
        continue;
      }
      if (node < kUpper && (node & kLeafMark) != 0) {
        if (!solve(node & ~kLeafMark, lower_m, entry.range)) return false;
        continue;
      }
      if (left_ < 2) {
        ++count_;
        left_ = 0;
        return false;
      }
      if (node < kUpper) {
        descend(node, lower_m, &entry, false);
      } else {
        const uint32_t before = count_;
        const uint32_t low = first_child(node - kUpper);
        visit_upper(low, lower_m, is_cold_);
        if (left_ == 0) {  // all were taken below the first one
          keep(parts_.upper(low + 1), lower_m, {}, false);
          return false;
        }
        visit_upper(low + 1, lower_m, is_cold_);
        if (count_ == before + 2) order(before);
      }
    }
    return true;
  }

  bool solve(uint32_t node, float lower_m, const Range& in) {
    Half<Range> halves[2];
    Range range = in;
    const Outcome outcome = parts_.solve(node, range, lower_m, left_, best_, halves);
    pass(node, 0.0f);
    if (outcome == Outcome::kStopped) put(node, lower_m, range);
    if (outcome == Outcome::kLost) lose(lower_m);
    if (outcome == Outcome::kSplit) {
      const uint32_t near = halves[1].lower_m < halves[0].lower_m ? 1 : 0;
      put(node, halves[1 - near].lower_m, halves[1 - near].range);
      put(node, halves[near].lower_m, halves[near].range);
    }
    return outcome != Outcome::kStopped;
  }
  void put(uint32_t node, float lower_m, const Range& range) {
    if (count_ >= kCapacity) return lose(lower_m);
    stack_[count_] = Entry(node | kLeafMark, lower_m);
    stack_[count_++].range = range;
  }

  SurfaceParts parts_;
  PatchBounds bounds_;
  Best& best_;
  float reach_m_ = 0.0f;  // of a new fence
  uint32_t marked_count_ = 0, last_marked_ = UINT32_MAX;
  uint16_t marked_[kMostMarks];  // nodes over pieces that are not farther than that
  bool is_cold_ = false;         // nothing is known yet: the nearer of two pieces comes first
  uint32_t count_ = 0;
  Entry stack_[kCapacity];
};

}  // namespace firmtouch::spline
