#pragma once
// The parts of a guide, by distance and penalty together, for .cpp files of this module only.
#include "firmtouch/spline/curve/expansion.hpp"
#include "firmtouch/spline/guide/arc.hpp"
#include "firmtouch/spline/guide/chain.hpp"

namespace firmtouch::spline {

/// What changes of arc cost.
struct Penalty {
  float per_m = 0;  // metres of distance for a metre of arc
  float at_m = 0;   // where it is nothing
  uint32_t piece = 0;
  float s = 0;
  Round round;  // the chain of that piece

  float of(uint32_t on, float arc_m) const {
    const float change_m = change_of_arc_m(round, at_m, on, arc_m);
    return per_m * (change_m < 0.0f ? -change_m : change_m);
  }
  /// Of arcs between two; nothing is between them and less.
  float least(float low_m, float high_m) const {
    if (low_m <= at_m && at_m <= high_m) return 0.0f;
    float min_m = low_m > at_m ? low_m - at_m : at_m - high_m;
    if (round.is_closed && high_m >= round.first_m && low_m <= round.last_m) {
      const float first_m = low_m > round.first_m ? low_m : round.first_m;
      const float last_m = high_m < round.last_m ? high_m : round.last_m;
      const float way_m = first_m > at_m ? last_m - at_m : at_m - first_m;
      const float other_m = round.length_m() - way_m;
      if (other_m < min_m) min_m = other_m;
    }
    return min_m > 0.0f ? per_m * min_m : 0.0f;
  }
};

/// A point's cost: false where it is not the least so far.
static inline bool take_cost(Best& best, float cost_m) {
  if (!(cost_m < best.distance_m)) return false;
  best.distance_m = cost_m;
  best.limit_m = cost_m * (1.0f - 16.0f * kUnit) - best.gap_m;
  return true;
}

/// Best holds costs in the place of distances.
class GuideNodes {
 public:
  using Range = CurveRange;

  /// Nothing of the curve is nearer than nearest_m. `kink` is the point where the penalty is
  /// nothing.
  GuideNodes(const GuideView& guide, math::Vec3 p_m, const Penalty& penalty, const CurvePoint& kink,
             Arcs& arcs, float nearest_m, const Best& best)
      : guide_(guide),
        curve_(guide.model(), p_m),
        p_m_(p_m),
        penalty_(penalty),
        kink_(kink),
        nearest_m_(nearest_m),
        best_(best),
        arcs_(arcs) {}

  bool is_leaf(uint32_t node) const { return curve_.is_leaf(node); }
  void children(uint32_t node, uint32_t& low, uint32_t& high) const {
    low = 2 * node;
    high = low + 1;
  }
  uint32_t sibling_of(uint32_t node) const { return node ^ 1u; }
  uint32_t parent_of(uint32_t node) const { return node >> 1; }
  uint32_t piece_of(uint32_t node) const { return curve_.piece_of(curve_.leaf_of(node)); }

  /// The node of the leaf that holds a place.
  uint32_t node_at(uint32_t piece, float s, Range& range) const {
    const uint32_t leaf = curve_.leaf_at(piece, s);
    range = curve_.range_of(leaf, 0.0f);
    range.start = s;
    return curve_.node_of(leaf);
  }

  /// The lowest node above one that holds all that is no farther along the curve than a reach.
  uint32_t node_around(uint32_t node, float reach_m) const;

  float bound_m(uint32_t node, Range& range) const {
    const CurveLevels::Leaves under = curve_.below(node);
    if (!is_any_of(under)) return FLT_MAX;
    const Stretch below = stretch_of(under, false);
    const float min_m = penalty_.least(below.low_m, below.high_m);
    const float by_arc_m = with_slack(nearest_m_, min_m);
    if (by_arc_m >= best_.limit_m) {  // no need to know how far off it is
      if (is_leaf(node)) range = curve_.range_of(curve_.leaf_of(node), 0.5f);
      return by_arc_m;
    }
    const CurveTree::Seen seen =
        curve_.see(curve_.off_m(under.first), curve_.off_m(under.end), curve_.radius_m(node));
    if (is_leaf(node)) range = curve_.range_of(curve_.leaf_of(node), seen.share);
    return seen.lower_m > nearest_m_ ? with_slack(seen.lower_m, min_m) : by_arc_m;
  }

  Outcome solve(uint32_t node, Range& range, float lower_m, query::Work& work, Best& best,
                Half<Range> (&halves)[2]);

 private:
  static constexpr uint32_t kMaxTurns = 5;
  static constexpr uint32_t kEvaluationWork = 3;  // in visits, beside its own

  // A change of arc on one side of where there is none, and on a closed chain the other way round.
  struct Way {
    float offset_m;  // what the other way costs more
    float per_m;     // along the curve: rising or falling
  };
  // What is left for the distance, outward from a point: at most first + slope d + half_bend d^2;
  // it falls by at least `fall` all along, where that is not 0.
  struct Room {
    float first_m, slope, half_bend, fall;
  };
  // The penalty's own derivatives, by s.
  struct Slopes {
    float first, second, third;
  };

  // A point of a piece, how far off it is, and what it costs to go there.
  struct Seen {
    CurvePoint at;
    float distance2_m2, distance_m;
    math::Vec3 r_m;
    float slope, bend, speed2;  // of D^2 / 2, and of the curve
    float arc_m, penalty_m;
    Slopes arc;
  };
  struct Sides {
    bool below, above;
  };

  static float with_slack(float distance_m, float penalty_m) {
    return (distance_m + penalty_m) * (1.0f - 4.0f * kUnit);
  }

  struct Stretch {
    float low_m, high_m;  // by arcs
  };
  // Not in what is no node, and where the curve is broken off.
  bool is_any_of(const CurveLevels::Leaves& under) const {
    return under.first <= curve_.last() &&
           (under.end - under.first > 1 || curve_.piece_of(under.first) != kNoLeaf);
  }
  Stretch stretch_of(const CurveLevels::Leaves& under, bool is_within) const;
  bool find_cut(uint32_t piece, const Range& range, float& at) const;
  float min_within(uint32_t piece, float low, float high) const;
  Half<Range> half(uint32_t piece, float low, float high, float lower_m) const {
    const float own_m = with_slack(nearest_m_, min_within(piece, low, high));
    return {{low, high, 0.5f * (low + high)}, own_m > lower_m ? own_m : lower_m};
  }
  Slopes slopes_at(float t) const;
  bool take_interval(uint32_t on, const Range& range, query::Work& work, Best& best);
  bool take_point(uint32_t on, uint32_t node, float s, query::Work& work, Best& best,
                  Seen& seen) const;
  static float step_from(const Seen& seen, const Way& way, float& gain_m2);
  bool prove(uint32_t on, const Seen& seen, float s, const Way* ways, uint32_t way_count,
             Range& range, Sides& sides) const;
  Outcome split(uint32_t on, const Range& range, float at, float lower_m,
                Half<Range> (&halves)[2]) const;
  uint32_t ways_of(uint32_t piece, const Range& range, Way (&ways)[2]) const;
  static Room room_of(const Slopes& arc, const Way& way, float limit_m, float outward,
                      float length);
  static bool is_side_done(const Expansion& f, float distance_m, float side, const Room& room,
                           float length);

  const GuideView& guide_;
  CurveTree curve_;
  math::Vec3 p_m_;
  const Penalty& penalty_;
  const CurvePoint& kink_;
  float nearest_m_;
  const Best& best_;
  Arcs& arcs_;
};

}  // namespace firmtouch::spline
