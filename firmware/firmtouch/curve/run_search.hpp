#pragma once
// Traversal of a curve's tree of runs, for .cpp files of this module only.

#include <float.h>

#include "firmtouch/curve/grid.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::curve {

constexpr uint32_t kNoRun = UINT32_MAX;
constexpr uint32_t kNoNode = UINT32_MAX;

// Boxes still to be looked at. Smallest key first while there is room for a whole descent, last in
// first out beyond, which needs one entry a level.
constexpr uint32_t kMaxTreeLevels =
    kMaxLevels - kMinRunLevels - 1;  // a run has 4 << levels segments
constexpr uint32_t kBestFirst = 64;  // within a tick's budget it never overflows
constexpr uint32_t kMaxPending = kBestFirst + kMaxTreeLevels + 1;

// Within a run a part of this many segments or more is a node of its own: a step.
constexpr uint32_t kStepSegments = 64;

/// A budget: how many steps it has and how many are left. The root, or the run where a warm
/// traversal starts, is one.
struct Steps {
  explicit Steps(query::Budget budget)
      : allowed(budget.steps == 0 ? 1 : budget.steps), left(allowed - 1) {}
  uint32_t allowed, left;
};

/// Result: false where a part of a run is a step and none is left.
static inline bool spend(uint32_t segments, uint32_t& left) {
  if (segments < kStepSegments) return true;
  if (left == 0) return false;
  --left;
  return true;
}

struct Pending {
  uint32_t key;
  uint32_t box;
};

/// Result of a traversal.
struct Traversal {
  uint32_t steps;
  bool complete;    // nothing is left that the visitor would accept
  float pending_m;  // where it is not: certified distance to everything that was not looked at;
                    // where it is: to all runs but the first, if that is beyond the visitor's reach
};

// Takes a key below `prune`: while there are more than `best_first`, the last, else the smallest.
// Result: false when there is none.
static inline bool take_next(Pending* pending, uint32_t& count, uint32_t best_first, uint32_t prune,
                             Pending& taken) {
  while (count > best_first) {
    taken = pending[--count];
    if (taken.key < prune) return true;
  }
  if (count == 0) return false;
  uint32_t at = count - 1;
  for (uint32_t i = at; i-- > 0;) at = pending[i].key < pending[at].key ? i : at;
  taken = pending[at];
  pending[at] = pending[--count];
  return taken.key < prune;
}

/// Offers every run that may matter to a visitor: from `start`, which it has begun with, up to the
/// root and into what lies beside the way; from the root where `start` is kNoRun.
///
/// The visitor has
///     float reach2_m2() const;       squared: what lies farther has nothing for it; never grows
///     bool take(uint32_t run, uint32_t& left);      false: no step was left
///     float others_m() const;                       certified distance to all runs so taken
///
/// Boxes nest to the bit, so the bound of the nearest box left never falls: more steps never widen
/// a certificate. A cold traversal takes the nearest box for its lower bound. A warm one has so
/// good an upper bound that the order does not matter, and saves the comparisons.
template <class Bound, class Visitor>
static inline Traversal traverse_runs(const View& curve, const Bound& bound_at, Steps steps,
                                      uint32_t start, bool has_begun, Visitor& visitor) {
  if (!has_begun) return {steps.allowed, false, 0.0f};
  const Bound bound = bound_at;  // in registers
  const Box* const boxes = curve.boxes().data();
  const Run* const runs = curve.runs().data();
  const uint32_t leaves = curve.runs().size() - 1;  // the first leaf's box
  const uint32_t allowed = steps.allowed;
  Pending pending[kMaxPending];
  uint32_t count = 0, left = steps.left;
  uint32_t prune;
  Pending now{0, 0};
  uint32_t best_first = kBestFirst, least = kFarthest;  // of what was left out
  if (start != kNoRun) {
    best_first = 0;
    prune = bound.prune_key(visitor.reach2_m2());
    for (uint32_t box = leaves + runs[start].leaf; box != 0; box = parent_of(box), --left) {
      if (left == 0) return {allowed, false, 0.0f};  // nothing is known of the rest of the way
      const uint32_t beside = ((box - 1) ^ 1u) + 1;
      const uint32_t key = bound.key(boxes[beside].side);
      if (key < prune)
        pending[count++] = {key, beside};
      else
        least = key < least ? key : least;
    }
    if (count == 0) return {allowed - left, true, bound.distance_m(least)};
    now = pending[--count];
  } else {
    prune = bound.prune_key(visitor.reach2_m2());
    ++left;
  }
  for (;;) {
    if (left == 0) break;
    --left;
    if (now.box < leaves) {
      const uint32_t first = first_child(now.box);
      const uint32_t key0 = bound.key(boxes[first].side), key1 = bound.key(boxes[first + 1].side);
      const uint32_t slot = key1 < key0 ? 1 : 0, far_key = slot ? key0 : key1;
      now = {slot ? key1 : key0, first + slot};
      if (far_key < prune) {  // and so is the nearer
        pending[count++] = {far_key, first + 1 - slot};
        continue;
      }
      const bool goes_on = now.key < prune;
      const uint32_t left_out = goes_on ? far_key : now.key;
      least = left_out < least ? left_out : least;
      if (goes_on) continue;
    } else {
      const float before_m2 = visitor.reach2_m2();
      if (!visitor.take(runs[now.box - leaves].run, left)) break;
      if (visitor.reach2_m2() < before_m2) {
        prune = bound.prune_key(visitor.reach2_m2());
        least = 0;  // what is pending may be dropped now
      }
    }
    if (!take_next(pending, count, best_first, prune, now)) {
      const float boxes_m = bound.distance_m(least), runs_m = visitor.others_m();
      return {allowed - left, true, boxes_m < runs_m ? boxes_m : runs_m};
    }
  }
  least = now.key;
  for (uint32_t i = 0; i < count; ++i) least = pending[i].key < least ? pending[i].key : least;
  return {allowed, false, bound.distance_m(least)};
}

}  // namespace firmtouch::curve
