#pragma once
// Traversal of a curve's tree of runs, for .cpp files of this module only.

#include <float.h>

#include "firmtouch/curve/grid.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::curve {

constexpr uint32_t kNoRun = UINT32_MAX;
constexpr uint32_t kNoNode = UINT32_MAX;

/// Within a run a part of this many segments or more is a node of its own: a visit.
constexpr uint32_t kVisitSegments = 64;

/// A budget: how many visits it has and how many are left. The root, or the run where a warm
/// traversal starts, is one.
struct Steps {
  explicit Steps(query::Budget budget)
      : allowed(budget.steps == 0 ? 1 : budget.steps), left(allowed - 1) {}
  uint32_t allowed, left;
};

/// Result: false where a part of a run is a visit and none is left.
static inline bool spend(uint32_t segments, uint32_t& left) {
  if (segments < kVisitSegments) return true;
  if (left == 0) return false;
  --left;
  return true;
}

/// Result of a traversal.
struct Traversal {
  uint32_t steps;
  bool complete;    // nothing is left that the visitor would accept
  float pending_m;  // where it is not: certified distance to everything that was not visited;
                    // where it is: to all runs but the first, if that is beyond the visitor's reach
};

/// Yields every run that may hold something nearer than a reach that never grows: from `start` up to
/// the root and into what lies beside the way, or from the root if `start` is kNoRun.
///
/// Boxes nest to the bit, so the bound of the nearest box left never falls: more visits never widen
/// a certificate. A cold traversal takes the nearest box for its lower bound. A warm one has so
/// good an upper bound that the order does not matter, and saves the comparisons.
class RunSearch {
 public:
  RunSearch(const View& curve, const RunBound& bound, Steps steps)
      : boxes_(curve.boxes().data()),
        runs_(curve.runs().data()),
        leaves_(curve.runs().size() - 1),
        bound_(bound),
        allowed_(steps.allowed),
        left_(steps.left) {}

  /// The first run; kNoRun if there is none.
  uint32_t begin(uint32_t start, float reach2_m2);
  /// The next run.
  uint32_t next(float reach2_m2);
  /// Visits left, for parts of runs.
  uint32_t& left() { return left_; }
  /// Pre: `others_m` bounds the distance to all runs that were yielded.
  Traversal result(float others_m) const;

 private:
  // Boxes still to be visited. Smallest key first while there is room for a whole descent, last in
  // first out beyond, which needs one entry a level. A run has 4 << levels segments.
  static constexpr uint32_t kMaxTreeLevels = kMaxLevels - kMinRunLevels - 1;
  static constexpr uint32_t kBestFirst = 64;  // within a tick's budget it never overflows
  static constexpr uint32_t kMaxPending = kBestFirst + kMaxTreeLevels + 1;
  struct Pending {
    uint32_t key;
    uint32_t box;
  };

  template <class Bound>
  bool ascend(const Bound& bound, uint32_t start);
  template <class Bound>
  uint32_t descend(const Bound& bound);
  bool take_next();

  const Box* boxes_;
  const Run* runs_;
  uint32_t leaves_;  // the first leaf's box
  const RunBound& bound_;
  uint32_t allowed_, left_;
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
///     float others_m() const;                       certified distance to all runs so taken
template <class Visitor>
static inline Traversal traverse_runs(const View& curve, const RunBound& bound, Steps steps,
                                      uint32_t start, Visitor& visitor) {
  RunSearch search(curve, bound, steps);
  uint32_t run = search.begin(start, visitor.reach2_m2());
  while (run != kNoRun && visitor.take(run, search.left())) run = search.next(visitor.reach2_m2());
  return search.result(visitor.others_m());
}

}  // namespace firmtouch::curve
