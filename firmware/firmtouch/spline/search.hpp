#pragma once
// Branch and bound over the parts of a model's pieces, for .cpp files of this room only.
#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/query/hint.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

constexpr float kUnit = 0x1p-24f;

/// The nearest point evaluated so far.
struct Best {
  float distance2_m2 = FLT_MAX;
  float distance_m = FLT_MAX;
  float limit_m = FLT_MAX;  // what is at least so far off need not be looked at
  float gap_m = 0;          // by how much less than the best that is, but for 3 units of it
  uint32_t node = 0;        // the leaf it is of
  float s = 0, t = 0;       // of the leaf's piece
  math::Vec3 x;             // from the piece's origin
  math::Vec3 along[2];      // the derivatives there
  float bend[3];            // of half the squared distance there, of a surface: uu, uv, vv
  uint32_t evaluations = 0;

  // By hand: else all is cleared by a call, and then most of it set.
  Best() {}

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

/// Where between 0 and 1, in a hint's 16 bits or half of them.
static inline uint32_t coded(float at, uint32_t most) {
  const float inside = at > 0.0f ? at < 1.0f ? at : 1.0f : 0.0f;
  return static_cast<uint32_t>(inside * static_cast<float>(most));
}
static inline float decoded(uint32_t code, uint32_t most) {
  return static_cast<float>(code) / static_cast<float>(most);
}

/// At least as long as the vector.
static inline float size_of(math::Vec3 v) {
  return __builtin_fabsf(v.x) + __builtin_fabsf(v.y) + __builtin_fabsf(v.z);
}

/// What rounding does to the slope of D^2 / 2 and to its change, beside what it does to D: the
/// model's loss bounds the error of a point, and with these factors that of its derivatives, whose
/// sums carry k, k (k - 1) or k (k - 1) (k - 2) more (and three times that where the weights' derivatives come in).
constexpr float kSlopeNoise = 20.0f, kBendNoise = 80.0f, kTwistNoise = 400.0f;

enum class Outcome : uint8_t { kClosed, kSplit, kStopped, kLost };

/// Shape: a curve's parts. It has
///     Range, a part of a leaf;
///     bool is_leaf(node), uint32_t sibling_of(node), parent_of(node);
///     void children(uint32_t node, uint32_t& low, uint32_t& high);
///     float bound_m(uint32_t node, Range& range): no point below the node is nearer. Of a leaf the range
///     is told;
///     Outcome solve(uint32_t leaf, Range& range, float lower_m, uint32_t& left, Best& best,
///                   Half (&halves)[2]);
/// solve() evaluates points of the range, each for one of `left` (as does a half that needs none), until what is left of it is beyond
/// the best's limit (kClosed), or in two halves with bounds of their own (kSplit); where float32 has
/// no point between the ends it is given up (kLost).
template <class Range>
struct Half {
  Range range;
  float lower_m;
};

template <class Shape>
class Search {
 public:
  using Range = typename Shape::Range;

  Search(Shape& shape, uint32_t budget, Best& best)
      : shape_(shape), budget_(budget == 0 ? 1 : budget), left_(budget_), best_(best) {}

  /// From a leaf that may be near up the tree, as far as a node `end` above it.
  void run(uint32_t leaf, const Range& range, uint32_t end) {
    Entry first{leaf, 0.0f, range};
    if (!solve(first) || !drain()) return stop();
    for (uint32_t node = leaf; node != end && best_.limit_m > 0.0f; node = shape_.parent_of(node)) {
      if (left_ == 0) return stop();
      visit(shape_.sibling_of(node), 0.0f);
      if (!drain()) return stop();
    }
    is_complete_ = true;
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
  struct Entry {
    uint32_t node;
    float lower_m;
    Range range;  // of a leaf
  };
  // One a level of the tree, one a halving of a leaf's range (24 to the end of float32), and two.
  static constexpr uint32_t kCapacity = kMaxLevels + 24 + 3;

  void stop() { is_cut_ = true; }

  void put(const Entry& entry) {
    if (count_ < kCapacity)
      stack_[count_++] = entry;
    else
      lose(entry.lower_m);
  }

  void lose(float lower_m) {
    if (lower_m < lost_m_) lost_m_ = lower_m;
  }

  // Reads a node and keeps it where it may hold something nearer.
  void visit(uint32_t node, float above_m) {
    --left_;
    Entry& entry = stack_[count_ < kCapacity ? count_ : kCapacity];
    entry.node = node;
    const float own_m = shape_.bound_m(node, entry.range);
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
      if (shape_.is_leaf(entry.node)) {
        if (!solve(entry)) return false;
      } else if (left_ < 2) {
        ++count_;
        left_ = 0;
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
    shape_.children(entry.node, low, high);
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
    const Outcome outcome = shape_.solve(node, entry.range, lower_m, left_, best_, halves);
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

  Shape& shape_;
  uint32_t budget_;
  uint32_t left_;
  Best& best_;
  float lost_m_ = FLT_MAX;  // bound of what the stack had no room for
  bool is_complete_ = false;
  bool is_cut_ = false;  // parts of the tree were not reached at all
  uint32_t count_ = 0;
  Entry stack_[kCapacity + 1];
};

}  // namespace firmtouch::spline
