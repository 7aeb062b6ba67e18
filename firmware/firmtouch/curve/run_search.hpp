#pragma once
// Traversal of a curve's tree of runs, for .cpp files of this module only.

#include "firmtouch/curve/grid.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::curve {

constexpr uint32_t kNoRun = UINT32_MAX;
constexpr uint32_t kNoNode = UINT32_MAX;

/// Within a run a part of this many segments or more is a node of its own: a visit.
constexpr uint32_t kVisitSegments = 64;

/// A budget: how many units it has and how many are left. The root, or the run where a warm
/// traversal starts, is one.
struct Steps {
  explicit Steps(query::Budget budget)
      : allowed(budget.work == 0 ? 1 : budget.work), left(allowed - 1) {}
  uint32_t allowed, left;
};

/// Takes units beyond the visits, at most what is left.
static inline void charge(uint32_t units, uint32_t& left, uint32_t& charged) {
  const uint32_t taken = units < left ? units : left;
  left -= taken;
  charged += taken;
}

/// Result of a traversal.
struct Traversal {
  uint32_t work;    // units used
  uint32_t steps;   // of them visits
  bool complete;    // nothing is left that the visitor would accept
  float pending_m;  // where it is not: certified distance to everything that was not visited;
                    // where it is: to all runs but the first, if that is beyond the visitor's reach
};

/// Yields every run that may hold something nearer than a reach that never grows: from `start` up
/// to the root and into what lies beside the way, or from the root if `start` is kNoRun.
///
/// Boxes nest to the bit, so the bound of the nearest box left never falls: more visits never widen
/// a certificate. A cold traversal takes the nearest box for its lower bound. A warm one has so
/// good an upper bound that the order does not matter, and saves the comparisons.
template <class Bound>
class RunSearch {
 public:
  RunSearch(const View& curve, const Bound& bound, Steps steps)
      : boxes_(curve.boxes().data()),
        runs_(curve.runs().data()),
        leaves_(curve.runs().size() - 1),
        bound_(bound),
        left_(steps.left) {}

  /// Result of begin() and next(): false where nothing is left to visit.
  bool begin(uint32_t start, float reach2_m2) {
    reach2_m2_ = reach2_m2;
    prune_ = bound_.prune_key(reach2_m2);
    if (start != kNoRun) return ascend(start);
    ++left_;
    return true;
  }
  bool next(float reach2_m2) {
    if (reach2_m2 < reach2_m2_) {
      reach2_m2_ = reach2_m2;
      prune_ = bound_.prune_key(reach2_m2);
      least_ = 0;  // what is pending may be dropped now
    }
    return take_next();
  }

  /// From the box at hand to the next run; kNoRun where nothing or no visit is left.
  uint32_t descend() {
    for (;;) {
      if (left_ == 0) return kNoRun;
      --left_;
      if (now_.box >= leaves_) return runs_[now_.box - leaves_].run;
      const uint32_t first = first_child(now_.box);
      const uint32_t key0 = bound_.key(boxes_[first].side);
      const uint32_t key1 = bound_.key(boxes_[first + 1].side);
      const uint32_t slot = key1 < key0 ? 1 : 0, far_key = slot ? key0 : key1;
      now_ = {slot ? key1 : key0, first + slot};
      if (far_key < prune_) {  // and so is the nearer
        pending_[count_++] = {far_key, first + 1 - slot};
        continue;
      }
      const bool goes_on = now_.key < prune_;
      const uint32_t left_out = goes_on ? far_key : now_.key;
      least_ = left_out < least_ ? left_out : least_;
      if (!goes_on && !take_next()) return kNoRun;
    }
  }

  /// Units left; runs take some.
  uint32_t left() const { return left_; }
  void set_left(uint32_t left) { left_ = left; }

  /// Pre: `others_m` bounds the distance to all runs that were yielded.
  Traversal result(uint32_t allowed, uint32_t charged, float others_m) const {
    const uint32_t work = allowed - left_, steps = work - charged - charged_;
    if (complete_) {
      const float boxes_m = bound_.distance_m(least_);
      return {work, steps, true, boxes_m < others_m ? boxes_m : others_m};
    }
    uint32_t least = now_.key;
    for (uint32_t i = 0; i < count_; ++i) least = pending_[i].key < least ? pending_[i].key : least;
    return {work, steps, false, bound_.distance_m(least)};
  }

 private:
  // Boxes still to be visited. Smallest key first while there is room for a whole descent, last in
  // first out beyond, which needs one entry a level. A run has 4 << levels segments.
  static constexpr uint32_t kMaxTreeLevels = kMaxLevels - kMinRunLevels - 1;
  static constexpr uint32_t kBestFirst = 64;  // within a tick's budget it never overflows
  static constexpr uint32_t kMaxPending = kBestFirst + kMaxTreeLevels + 1;
  static constexpr uint32_t kScannedInUnit = 16;
  struct Pending {
    uint32_t key;
    uint32_t box;
  };

  // From a run to the root.
  bool ascend(uint32_t start) {
    best_first_ = 0;
    for (uint32_t box = leaves_ + runs_[start].leaf; box != 0; box = parent_of(box), --left_) {
      if (left_ == 0) {  // nothing is known of the rest of the way
        count_ = 0;
        return false;
      }
      const uint32_t beside = ((box - 1) ^ 1u) + 1;
      const uint32_t key = bound_.key(boxes_[beside].side);
      if (key < prune_)
        pending_[count_++] = {key, beside};
      else
        least_ = key < least_ ? key : least_;
    }
    complete_ = count_ == 0;
    if (complete_) return false;
    now_ = pending_[--count_];
    return true;
  }

  // Takes a box below `prune_`: while there are more than `best_first_`, the last, else the
  // smallest. Result: false when there is none; the traversal is complete.
  bool take_next() {
    while (count_ > best_first_) {
      now_ = pending_[--count_];
      if (now_.key < prune_) return true;
    }
    complete_ = true;
    if (count_ == 0) return false;
    charge(count_ / kScannedInUnit, left_, charged_);
    uint32_t at = count_ - 1;
    for (uint32_t i = at; i-- > 0;) at = pending_[i].key < pending_[at].key ? i : at;
    now_ = pending_[at];
    pending_[at] = pending_[--count_];
    complete_ = now_.key >= prune_;
    return !complete_;
  }

  const Box* boxes_;
  const Run* runs_;
  uint32_t leaves_;  // the first leaf's box
  const Bound& bound_;
  uint32_t left_, charged_ = 0;
  float reach2_m2_ = 0;
  uint32_t prune_ = 0;
  uint32_t best_first_ = kBestFirst;
  uint32_t least_ = kFarthest;  // key of what was left out
  bool complete_ = false;
  uint32_t count_ = 0;
  Pending now_{0, 0};
  Pending pending_[kMaxPending];
};

/// Offers every run that may matter to a visitor, which has
///     float reach2_m2() const;       squared: what lies farther has nothing for it; never grows
///     bool take(uint32_t run, uint32_t& left);      false: no visit was left
///     uint32_t charged() const;                     units that take() took beyond visits
///     float others_m() const;                       certified distance to all runs so taken
/// Out of line: most queries end at the safe subtree and do not need its frame.
template <class Bound, class Visitor>
[[gnu::noinline]] static inline Traversal traverse_runs(const View& curve, const Bound& bound,
                                                        uint32_t start, Steps steps,
                                                        Visitor& visitor) {
  RunSearch<Bound> search(curve, bound, steps);
  for (bool goes_on = search.begin(start, visitor.reach2_m2()); goes_on;
       goes_on = search.next(visitor.reach2_m2())) {
    const uint32_t run = search.descend();
    if (run == kNoRun) break;
    uint32_t left = search.left();  // of its own: else all of the search stays in memory
    const bool is_done = visitor.take(run, left);
    search.set_left(left);
    if (!is_done) break;
  }
  return search.result(steps.allowed, visitor.charged(), visitor.others_m());
}

}  // namespace firmtouch::curve
