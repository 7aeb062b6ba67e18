#pragma once
// What the searches of this module share, for .cpp files of this module only.
#include <float.h>

#include "firmtouch/query/work.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/numbers.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// A node that is at most so much of the extent nearer than the best point is not searched: what is
/// left of the 4e-7 and 1e-6 that `exact` promises when the losses are taken off.
constexpr float kGap = 1.5f * kUnit, kRationalGap = 4.0f * kUnit;

/// The nearest point evaluated so far.
struct Best {
  float distance2_m2 = FLT_MAX;
  float distance_m = FLT_MAX;
  float limit_m = FLT_MAX;  // what is at least so far off need not be looked at
  float gap_m;              // by how much less than the best that is, beside 3 units of it
  uint32_t node = 0;        // the leaf it is of
  float s = 0, t = 0;       // of the leaf's piece
  math::Vec3 x;             // from the piece's origin
  math::Vec3 along[2];      // the derivatives there
  float bend[3];            // of half the squared distance there, of a surface: uu, uv, vv
  uint32_t evaluations = 0;

  explicit Best(const Head& head)
      : gap_m(head.extent_m * (head.is_rational != 0 ? kRationalGap : kGap)) {}

  bool take(float d2) {
    if (!(d2 < distance2_m2)) return false;
    distance2_m2 = d2;
    distance_m = math::square_root(d2);
    limit_m = distance_m * (1.0f - 3.0f * kUnit) - gap_m;
    return true;
  }
  /// Of a lower bound of squared distance: it need not be looked at. The rounding of the three
  /// operations fits in the 6 units by which the limit's square is below the best's.
  bool is_beyond(float lower2_m2) const {
    return limit_m <= 0.0f || lower2_m2 * (1.0f - 2.0f * kUnit) >= limit_m * limit_m;
  }
  /// A lower bound that is beyond.
  float enough2() const { return limit_m * limit_m * (1.0f + 4.0f * kUnit); }
  /// Whether a squared distance, seen without its error, is.
  bool seems_beyond(float lower2_m2) const {
    return limit_m <= 0.0f || lower2_m2 >= limit_m * limit_m;
  }
};

/// The same of a query that needs nothing beyond a band.
struct BandedBest : Best {
  float band_m;

  BandedBest(const Head& head, float band) : Best(head), band_m(math::larger(band, 0.0f)) {}
  bool take(float d2) {
    if (!Best::take(d2)) return false;
    if (band_m < limit_m) limit_m = band_m;
    return true;
  }
  bool is_beyond_band() const { return limit_m >= band_m; }
  float needed_m() const { return distance_m < band_m ? distance_m : band_m; }
};

/// Where between 0 and 1, in a hint's 16 bits.
static inline uint32_t coded(float at, uint32_t most) {
  const float inside = at > 0.0f ? at < 1.0f ? at : 1.0f : 0.0f;
  return static_cast<uint32_t>(inside * static_cast<float>(most));
}

/// What became of a part whose points were evaluated, each for one step: all of it is beyond the
/// best's limit; it is left in two halves with bounds of their own; the budget ended; float32 has
/// no point between its ends, and it is given up.
enum class Outcome : uint8_t { kClosed, kSplit, kStopped, kLost };

template <class Range>
struct Half {
  Range range;
  float lower_m;
};

/// What every search accounts for: its work, and what it had no room or no time to look at. It
/// counts in visits of nodes, `per_visit` units each.
class Account {
 public:
  bool is_complete() const { return is_complete_ && lost_m_ >= FLT_MAX; }
  uint32_t steps() const { return work_.visits(); }
  /// In units.
  uint32_t work() const {
    const uint32_t used = work_.used() * per_visit_;
    return used < budget_ ? used : budget_;
  }

 protected:
  Account(uint32_t budget, uint32_t per_visit)
      : work_(query::Budget{budget / per_visit}),
        budget_(budget == 0 ? 1 : budget),
        per_visit_(per_visit) {}

  void stop() { is_cut_ = true; }
  void lose(float lower_m) {
    if (lower_m < lost_m_) lost_m_ = lower_m;
  }
  /// Certified distance to all that was not looked at, before what float32 loses: what waits on a
  /// stack has lower bounds of its own, and nothing of the model is nearer than outside_m.
  template <class Entry>
  float min_pending_m(const Entry* stack, uint32_t count, float outside_m) const {
    float min_m = lost_m_;
    if (is_cut_) min_m = outside_m;
    for (uint32_t i = 0; i < count; ++i)
      if (stack[i].lower_m < min_m) min_m = stack[i].lower_m;
    return min_m;
  }

  query::Work work_;
  uint32_t budget_, per_visit_;
  float lost_m_ = FLT_MAX;  // bound of what the stack had no room for
  bool is_complete_ = false;
  bool is_cut_ = false;  // parts of the tree were not reached at all
};

}  // namespace firmtouch::spline
