#pragma once
// Lower bounds of the distance to the boxes of a curve, for .cpp files of this module only.

#include "firmtouch/curve/derived.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/query/box_bound.hpp"

namespace firmtouch::curve {

using query::kFarthest;
constexpr uint32_t kBoundUnits = 256;  // of 2^-24: more than any bound below loses (derived there)

/// The query is inside the grid. Keys read a word behind the box: the sections' padding, which a
/// count of boxes that is odd never leaves empty.
using NearBound = query::NearBoxBound<kBoundUnits>;

/// The query is outside the grid.
///
/// Each axis has an error of at most u (|x| + d) with u = 2^-24, x = p - grid_low and |x| <= d + 2
/// extents <= 17.2 d (open() lets the grid begin at most an extent below the box), so 18.2 u d an
/// axis, 32 u d for the three, 64 u in the square and 4 for its sum. The boxes' slack of 2^-10
/// cells an axis is, with a grid of at most four extents, 2^-10 * 4 / 32768 * 8.1 d = 17 u d, 29 u
/// d for the three, 58 u in the square: 126 of the 256 units that kRoundDown takes.
using FarBound = query::FarBoxBound<kBoundUnits>;

/// The one that fits the query. Pre: the query is near (answer.hpp).
struct RunBound {
  RunBound(const Head& head, math::Vec3 p_m)
      : is_far(!near.begin(head.grid_low_m, head.cell_m, p_m)) {
    if (is_far) far.begin(head.grid_low_m, head.cell_m, p_m);
  }
  /// Whether distances need compensation: a 32nd of the diagonal outside the root box they may
  /// exceed the diagonal, and plain floats do not keep 4e-7 of the distance.
  bool is_compensated(const View& curve) const {
    const float margin_m = curve.head().diagonal_m * 0x1p-5f;
    return is_far || near.key(curve.boxes()[0].side) >= near.prune_key(margin_m * margin_m);
  }
  uint32_t key(const uint32_t* box) const { return is_far ? far_key(box) : near.key(box); }
  uint32_t prune_key(float distance2_m2) const {
    return is_far ? far.prune_key(distance2_m2) : near.prune_key(distance2_m2);
  }
  float distance_m(uint32_t key) const {
    return is_far ? far.distance_m(key) : near.distance_m(key);
  }

  NearBound near;
  FarBound far;
  bool is_far;

 private:
  [[gnu::noinline]] uint32_t far_key(const uint32_t* box) const { return far.key(box); }
};

}  // namespace firmtouch::curve
