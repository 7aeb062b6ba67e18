#pragma once
// Branch and bound over the parts of surfaces, for .cpp files of this module only.
#include "firmtouch/spline/search.hpp"
#include "firmtouch/spline/surface/frontier.hpp"
#include "firmtouch/spline/surface/nodes.hpp"
#include "firmtouch/spline/surface/patch_bounds.hpp"

namespace firmtouch::spline {

class SurfaceSearch : public Account {
 public:
  using Range = Rectangle;

  SurfaceSearch(const View& model, math::Vec3 p_m, uint32_t budget, BandedBest& best)
      : Account(budget, kVisitWork), nodes_(model, p_m), bounds_(model, p_m), best_(best) {}

  bool resume(const CurveHint& hint, uint32_t& leaf, Range& range) const {
    return nodes_.resume(hint, leaf, range);
  }
  void leave(math::Vec3 motion_m, CurveHint& hint) const { nodes_.leave(best_, motion_m, hint); }
  uint32_t piece_of(uint32_t node) const { return node >> 16; }

  /// From a leaf that may be near: where the frontier is far enough away only what of it may be
  /// within the limit, else all, and a new frontier is stored, to `margin_m` beyond the best.
  void run_warm(uint32_t leaf, const Range& range, float margin_m, Frontier& frontier) {
    FrontierUse use(frontier);
    run_from(leaf, range, margin_m, use, frontier);
    if (!is_complete()) use.clear();
  }

  void run_cold(float outside_m) {
    const uint32_t root = nodes_.root();
    if (root >= kUpper)
      stack_[count_++] = Entry(root, outside_m);
    else
      visit_upper(0, outside_m);
    is_complete_ = drain();
  }

  float pending_m(float outside_m) const { return min_pending_m(stack_, count_, outside_m); }

 private:
  static constexpr uint32_t kVisitWork = 3;
  void run_from(uint32_t leaf, const Range& range, float margin_m, FrontierUse& use,
                Frontier& frontier) {
    if (!solve(leaf, 0.0f, range, false)) return stop();
    const bool is_closed = count_ == 0;
    if (!drain()) return stop();
    uint32_t needed;
    bool holds = best_.limit_m > 0.0f && use.needs(best_.limit_m, needed);
    if (holds && !look(leaf, is_closed, needed, use, frontier, holds)) return stop();
    if (!holds) {
      const float reach_m = best_.needed_m() + margin_m;
      passed_.start(reach_m);
      if (!ascend(leaf, is_closed, nodes_.root())) return stop();
      use.renew(best_.limit_m, reach_m, passed_);
    }
    is_complete_ = true;
  }

  // At the patches of a frontier that may hold something nearer: all are read, and what then may
  // still hold it is gone through nearest first, as below one node, so that what closes one part
  // closes others about it.
  bool look(uint32_t leaf, bool is_closed, uint32_t needed, FrontierUse& use, Frontier& frontier,
            bool& holds) {
    passed_.start(use.outside_m());
    uint32_t kept = 0;
    for (uint32_t k = 0; k < frontier.count; ++k) {
      const uint32_t node = frontier.node[k];
      if (frontier.beyond[k] >= needed) {
        frontier.node[kept] = node;
        frontier.beyond[kept++] = frontier.beyond[k];
        continue;
      }
      holds = nodes_.is_node(node);
      if (!holds) break;  // no hint of this model
      if (!look_at(node, leaf, is_closed)) return false;
    }
    frontier.count = static_cast<uint8_t>(kept);
    if (!drain()) return false;
    if (holds) use.add(passed_);
    return true;
  }
  bool look_at(uint32_t node, uint32_t leaf, bool is_closed) {
    const bool is_about = (node >= kUpper || (node ^ leaf) >> 16 == 0) && nodes_.holds(node, leaf);
    if (is_about && is_closed && node < kUpper && nodes_.is_closed_in_cell(node, best_)) {
      pass_closed(node);
      return true;
    }
    if (work_.left == 0) return false;
    if (is_about) return ascend(leaf, is_closed, node);
    visit(node);
    return count_ <= kMaxWaiting || drain();
  }
  static constexpr uint32_t kMaxWaiting = 6;
  void visit(uint32_t node) {
    if (node < kUpper)
      descend(node, 0.0f, nullptr);
    else
      visit_upper(node - kUpper, 0.0f);
  }
  // From a leaf that is done with up to a node that holds it: all that is beside the way.
  bool ascend(uint32_t leaf, bool is_closed, uint32_t top) {
    uint32_t node =
        is_closed && nodes_.was_closed_last(leaf) ? nodes_.closed_around(leaf, best_) : leaf;
    if (top < kUpper && node <= top)
      node = top;  // of two parts about a leaf the larger one has the lower number
    pass(node, best_.limit_m);
    while (node != top && (node & 0xFFFFu) != kWholePiece) {
      if (work_.left == 0) return false;
      const PatchNode patch = apart(bounds_.come_near(node >> 16), node);
      descend(node ^ (was_halved_u(patch) ? kNextU : kNextV), 0.0f, nullptr);
      if (!drain()) return false;
      node = whole_of(node, patch);
    }
    if (node == top) return true;
    for (uint32_t i = nodes_.upper_of(node); i != 0 && nodes_.upper(i) != top; i = parent_of(i)) {
      if (work_.left == 0) return false;
      visit_upper(sibling_of(i), 0.0f);
      if (!drain()) return false;
    }
    return true;
  }

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
  static constexpr uint32_t kHalfMark = 1u << 15;  // of a leaf: not all of it
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), three,
  // and what waits of a frontier.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 4 + 8;
  // The same below any entry, without the levels of the tree over the pieces.
  static constexpr uint32_t kMinLevels = 2 * kMaxHalvingsAcross + 24 + 4;

  // A node, as it is on the stack, that need not be looked at.
  void pass(uint32_t node, float lower_m) { passed_.pass(node, lower_m); }
  void pass_closed(uint32_t node) { passed_.pass(node, nodes_.reported_m()); }

  [[gnu::noinline]] void visit_upper(uint32_t i, float above_m) {
    const uint32_t node = nodes_.upper(i);
    if (node < kUpper) return descend(node, above_m, nullptr);
    --work_.left;
    const float own_m = bounds_.box_m(i), lower_m = own_m < above_m ? above_m : own_m;
    if (!(lower_m < best_.limit_m)) return pass(node, lower_m);
    if (count_ >= kCapacity) return lose(lower_m);
    stack_[count_].node = node;
    stack_[count_++].lower_m = lower_m;
  }

  void keep(uint32_t node, float lower_m, const NodeBound& reported, bool is_leaf) {
    if (count_ >= kCapacity) return lose(lower_m);
    Entry& entry = stack_[count_++];
    entry.lower_m = lower_m;
    if (is_leaf) {
      entry.node = node | kLeafMark;
      entry.range = nodes_.range_of(node, reported.x, reported.y);
    } else {
      entry.node = node;
      entry.halves.far_half = reported.far_half;
      entry.halves.far_m = reported.far_m;
    }
  }

  // Reads a part of a piece, and of its halves the nearer one on and on, as far as the limit or a
  // leaf. What else may hold something nearer goes to the stack. `known`: it has been read already.
  // A whole piece goes there, too: first the nearest of several is read.
  [[gnu::noinline]] void descend(uint32_t node, float above_m, const Entry* known) {
    const Piece& piece = bounds_.come_near(node >> 16);
    uint32_t u = (node >> 7) & 127u, v = node & 127u;
    uint32_t left_u = piece.level_u - digits_of(u), left_v = piece.level_v - digits_of(v);
    NodeBound reported{};
    bool is_known = known != nullptr;
    if (is_known) {
      reported.far_half = known->halves.far_half;
      reported.far_m = known->halves.far_m;
    }
    uint32_t near_node = 0;       // where the farther half is read: the nearer one is read after it
    float far_lower_m = FLT_MAX;  // of the farther half, where it is kept
    for (;;) {
      const bool next_u = left_u >= left_v;
      if (!is_known) {
        --work_.left;
        const bool is_leaf = left_u + left_v == 0;
        const bool is_kept =
            !bounds_.is_beyond(u, v, left_u, left_v, next_u, best_.limit_m, reported);
        const float lower_m = math::larger(reported.lower_m, above_m);
        if (near_node != 0) {
          if (is_kept) {
            far_lower_m = lower_m;
            keep(node, lower_m, reported, is_leaf);
          } else {
            pass(node, lower_m);
          }
          node = near_node;
          near_node = 0;
          u = (node >> 7) & 127u, v = node & 127u;
          continue;
        }
        if (!is_kept) return pass(node, lower_m);
        if (is_leaf || (node & 0xFFFFu) == kWholePiece || lower_m > far_lower_m || work_.left < 2) {
          keep(node, lower_m, reported, is_leaf);
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
      if (reported.far_m >= best_.limit_m) {
        pass(reported.far_half == 0 ? node : node + next, reported.far_m);
        if (reported.far_half == 0) node += next;
      } else if (reported.far_half == 0) {
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
    swap(before, before + 1);
  }
  [[gnu::noinline]] void swap(uint32_t i, uint32_t k) {
    const Entry first = stack_[i];
    stack_[i] = stack_[k];
    stack_[k] = first;
  }

  // False: the budget ended, and what is left stands on the stack.
  bool drain() { return count_ == 0 || drain_all(); }
  [[gnu::noinline]] bool drain_all() {
    while (count_ > 0) {
      const Entry& entry = stack_[--count_];
      const bool is_half = entry.node < kUpper && (entry.node & kHalfMark) != 0;
      const uint32_t node = is_half ? entry.node & ~kHalfMark : entry.node;
      const float lower_m = entry.lower_m;
      if (lower_m >= best_.limit_m) {
        if (!is_half) pass(node < kUpper ? node & ~kLeafMark : node, lower_m);
        continue;
      }
      if (nodes_.is_closed(node & ~kLeafMark, best_)) {
        if (!is_half) pass_closed(node & ~kLeafMark);
        continue;
      }
      if (node < kUpper && (node & kLeafMark) != 0) {
        if (!solve(node & ~kLeafMark, lower_m, entry.range, is_half)) return false;
        continue;
      }
      if (work_.left < 2) {
        ++count_;
        return false;
      }
      if (node < kUpper) {
        descend(node, lower_m, &entry);
      } else {
        const uint32_t before = count_;
        const uint32_t low = first_child(node - kUpper);
        visit_upper(low, lower_m);
        if (work_.left == 0) {  // all were taken below the first one
          keep(nodes_.upper(low + 1), lower_m, {}, false);
          return false;
        }
        visit_upper(low + 1, lower_m);
        if (count_ == before + 2) order(before);
      }
    }
    return true;
  }

  // Of a leaf that is halved its own bound is known; the bounds of its halves are not its own.
  bool solve(uint32_t node, float lower_m, const Range& in, bool is_half) {
    Half<Range> halves[2];
    Range range = in;
    const Outcome outcome = nodes_.solve(node, range, lower_m, work_, best_, halves);
    if (!is_half) pass(node, outcome == Outcome::kClosed ? nodes_.reported_m() : lower_m);
    if (outcome == Outcome::kStopped) put(node, lower_m, range);
    if (outcome == Outcome::kLost) lose(lower_m);
    if (outcome == Outcome::kSplit) {
      const uint32_t near = halves[1].lower_m < halves[0].lower_m ? 1 : 0;
      put(node | kHalfMark, halves[1 - near].lower_m, halves[1 - near].range);
      put(node | kHalfMark, halves[near].lower_m, halves[near].range);
      turn_to_nearer();
    }
    return outcome != Outcome::kStopped;
  }
  // From a leaf that no proof closes to what may be nearer: where a whole ring of leaves is equally
  // near, they would take the budget before a pole inside the ring is seen. Only while the stack
  // has room for the longest descent from there.
  [[gnu::noinline]] void turn_to_nearer() {
    if (count_ > kCapacity - kMinLevels - nodes_.levels_above()) return;
    uint32_t nearest = count_ - 1;
    for (uint32_t i = 0; i < count_; ++i)
      if (stack_[i].lower_m < stack_[nearest].lower_m) nearest = i;
    if (stack_[nearest].lower_m < 0.875f * stack_[count_ - 1].lower_m) swap(nearest, count_ - 1);
  }
  void put(uint32_t node, float lower_m, const Range& range) {
    if (count_ >= kCapacity) return lose(lower_m);
    stack_[count_] = Entry(node | kLeafMark, lower_m);
    stack_[count_++].range = range;
  }

  SurfaceNodes nodes_;
  PatchBounds bounds_;
  BandedBest& best_;
  FarNodes passed_;
  uint32_t count_ = 0;
  Entry stack_[kCapacity];
};

}  // namespace firmtouch::spline
