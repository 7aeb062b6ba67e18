#pragma once
// The parts of curves for Search, for .cpp files of this room only.
#include "firmtouch/spline/evaluation.hpp"
#include "firmtouch/spline/leaf_shape.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

class CurveParts {
 public:
  struct Range {
    float low, high;  // of the piece's s
    float start;      // where to evaluate first
  };

  CurveParts(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        coefficients_(model.coefficients().data()),
        leaves_(model.leaves().data()),
        bends_(model.bends().data()),
        capsules_(model.capsules().data()),
        points_(model.points().data()),
        base_(model.leaf_count() - 1),
        loss_m_(model.head().loss_m),
        p_m_(p_m) {}

  uint32_t root() const { return 0; }
  bool is_leaf(uint32_t node) const { return node >= base_; }
  void children(uint32_t node, uint32_t& low, uint32_t& high) const {
    low = first_child(node);
    high = low + 1;
  }
  uint32_t sibling_of(uint32_t node) const { return spline::sibling_of(node); }
  uint32_t parent_of(uint32_t node) const { return spline::parent_of(node); }

  /// The leaf of a hint, from where it was left: none for a hint that is none.
  bool resume(const query::Hint& hint, uint32_t& node, Range& range) const {
    const uint32_t place = hint.place;
    const uint32_t leaf = place >> 16;
    if (leaf > base_) return false;
    node = base_ + leaf;
    range = range_of(leaf, decoded(place & 0xFFFFu, 65535));
    return true;
  }
  void leave(const Best& best, math::Vec3, query::Hint& hint) const { hint.place = place_of(best); }
  uint32_t place_of(const Best& best) const {
    const Range range = range_of(best.node - base_, 0.0f);
    return (best.node - base_) << 16 |
           coded((best.s - range.low) / (range.high - range.low), 65535);
  }
  uint32_t piece_of(uint32_t node) const { return leaves_[node - base_].piece; }

  bool is_closed(uint32_t, const Best&) const { return false; }  // rare, and bounds are cheap
  uint32_t closed_around(uint32_t leaf, const Best&) const { return leaf; }

  static constexpr bool kTellsHalves = false;
  static float child_bound_m(const Range&, uint32_t, float lower_m) { return lower_m; }
  // The stored radius holds what float32 loses here (with_slack()).
  float bound_m(uint32_t node, float, Range& range) const {
    const Capsule& capsule = capsules_[node];
    const math::Vec3 a_m = point(capsule.first);
    const math::Vec3 from_m = p_m_ - a_m, along_m = point(capsule.last) - a_m;
    const float length2_m2 = dot(along_m, along_m), progress_m2 = dot(from_m, along_m);
    float t = progress_m2 > 0.0f ? progress_m2 / length2_m2 : 0.0f;
    if (!(t < 1.0f)) t = 1.0f;
    const float off_m = math::length(from_m - along_m * t);
    if (node >= base_) range = range_of(node - base_, t);
    return off_m * (1.0f - 0x1p-20f) - from_half(capsule.radius);
  }

  Outcome solve(uint32_t node, Range& range, float lower_m, uint32_t& left, Best& best,
                Half<Range> (&halves)[2]) {
    const uint32_t leaf = node - base_;
    const Piece& piece = pieces_[leaves_[leaf].piece];
    const math::Vec3 q_m = p_m_ - vec3_at(piece.origin_m);
    const float fixed = from_half(bends_[leaf].fixed), turning = from_half(bends_[leaf].turning);
    float s = range.start;
    for (uint32_t turn = 0; turn < kMostTurns; ++turn) {
      if (left == 0) {
        range.start = s;
        return Outcome::kStopped;
      }
      --left;
      ++best.evaluations;
      CurvePoint at;
      evaluate(piece, coefficients_, s, at);
      const math::Vec3 r_m = at.x - q_m;
      const float distance2_m2 = dot(r_m, r_m), speed2 = dot(at.d1, at.d1);
      if (best.take(distance2_m2)) {
        best.node = node;
        best.s = s;
        best.x = at.x;
        best.along[0] = at.d1;
      }
      const float slope = dot(r_m, at.d1), bend = speed2 + dot(r_m, at.d2);
      // Where Newton's step leads within the range, and what it would gain there is needed, no proof can
      // hold yet.
      float next = bend > 0.0f ? s - slope / bend : slope > 0.0f ? range.low : range.high;
      if (next > range.low && next < range.high && turn + 1 < kMostTurns &&
          !best.seems_beyond(distance2_m2 + slope * (next - s))) {
        s = next;
        continue;
      }
      const Expansion f = expand(distance2_m2, bend, speed2, at, fixed, turning);
      const float below2 = f.least2(-slope, s - range.low),
                  above2 = f.least2(slope, range.high - s);
      const bool is_below_done = best.is_beyond(below2), is_above_done = best.is_beyond(above2);
      if (is_below_done) range.low = s;
      if (is_above_done) range.high = s;
      if (is_below_done && is_above_done) return Outcome::kClosed;
      if (!(next > range.low)) next = range.low;
      if (!(next < range.high)) next = range.high;
      const float step = next - s;
      if (!(step > 0.0f || step < 0.0f)) {  // Newton goes no further, yet a side is not proven
        if (!is_below_done && !is_above_done) {
          halves[0] = half(range.low, s, lower_m, below2);
          halves[1] = half(s, range.high, lower_m, above2);
          return Outcome::kSplit;
        }
        next = 0.5f * (range.low + range.high);
      }
      s = next;
    }
    const float middle = 0.5f * (range.low + range.high);
    if (!(middle > range.low && middle < range.high)) return Outcome::kLost;
    halves[0] = half(range.low, middle, lower_m, 0.0f);
    halves[1] = half(middle, range.high, lower_m, 0.0f);
    return Outcome::kSplit;
  }

  /// D^2 / 2 about a point: its bend there as small as it may be, and how far the bend changes a unit
  /// of s.
  struct Expansion {
    float distance2, slope_noise, least_bend, change;

    // The least of D^2 on one side, over a length: outward slope and bend as small as they may be,
    // f(d) >= f + slope d + (bend - change length / 3) d^2 / 2, whose least over 0 to length is
    // told.
    float least2(float outward, float length) const {
      const float g = outward - slope_noise;
      const float q = least_bend - change * length * 0.33333337f;
      if (q > 0.0f && g < 0.0f && -g < q * length) return distance2 - g * (g / q);
      const float end = (2.0f * g + q * length) * length;
      return end < 0.0f ? distance2 + end : distance2;
    }
  };

  Expansion expand(float distance2, float bend, float speed2, const CurvePoint& at, float fixed,
                   float turning) const {
    const float distance_m = math::square_root(distance2);
    const float speed = math::square_root(speed2) * (1.0f + 0x1p-20f), swing = size_of(at.d2);
    Expansion f;
    f.distance2 = distance2;
    f.slope_noise =
        speed * (loss_m_ + 6.0f * kUnit * distance_m) + kSlopeNoise * loss_m_ * distance_m;
    f.least_bend = bend - kBendNoise * loss_m_ * (speed + distance_m) -
                   8.0f * kUnit * (speed2 + distance_m * swing);
    f.change = (fixed + turning * distance_m) * (1.0f + 0x1p-20f);
    return f;
  }

  /// A leaf, to be begun at a share of its length.
  Range range_of(uint32_t leaf, float share) const {
    const Leaf& at = leaves_[leaf];
    const float wide = math::float_of((128u - pieces_[at.piece].level_u) << 23);  // 2^(1 - level)
    const float low = static_cast<float>(static_cast<uint32_t>(at.index_u)) * wide - 1.0f;
    return {low, low + wide, low + wide * share};
  }

 private:
  static constexpr uint32_t kMostTurns = 5;

  static Half<Range> half(float low, float high, float lower_m, float lower2) {
    const float own_m = lower2 > 0.0f ? math::square_root(lower2) * (1.0f - 0x1p-21f) : 0.0f;
    return {{low, high, 0.5f * (low + high)}, own_m > lower_m ? own_m : lower_m};
  }

  math::Vec3 point(uint32_t i) const { return {points_[i].x_m, points_[i].y_m, points_[i].z_m}; }

  const Piece* pieces_;
  const float* coefficients_;
  const Leaf* leaves_;
  const Bend* bends_;
  const Capsule* capsules_;
  const Point* points_;
  uint32_t base_;
  float loss_m_;
  math::Vec3 p_m_;
};

}  // namespace firmtouch::spline
