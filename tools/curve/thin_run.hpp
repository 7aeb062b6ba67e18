#pragma once
#include <string>
#include <vector>

#include "curve/curve_points.hpp"

namespace firmtouch::tools {

struct Place {
  double x_m, y_m, z_m;
};

/// A recorded run, thinned.
struct ThinnedRun {
  CurvePoints points;          // rows: which place each sample is
  double max_deviation_m = 0;  // of any place from the piece that stands for it, as measured
};

/// Leaves places out so long as each lies within `max_m` of the straight piece, between float32
/// samples, that stands for it. So the guide and the run, joined place to place, lie within max_m
/// of each other everywhere, either way: distance to a piece is convex along the run, and the run
/// between two samples passes beside every point of their piece.
/// Bounds: O(n log n); the same samples on every machine.
/// Result: points.problem says where max_m is finer than float32 can hold there, or the run stands
/// still.
ThinnedRun thin_run(const std::vector<Place>& run, double max_m, const std::string& name);

}  // namespace firmtouch::tools
