#pragma once
#include <vector>

#include "firmtouch/curve/layout.hpp"

namespace firmtouch::tools {

struct CurveRuns {
  std::vector<curve::Box> boxes;
  std::vector<curve::Run> runs;
  std::vector<uint16_t> radii;
};

/// How often runs are halved, as measured (firmware/firmtouch/curve/README.md, Cost).
uint32_t choose_run_levels(uint32_t sample_count);

/// Sets grid_low_m and cell_m from the head's box: the finest grid that open() takes. `beyond`: how
/// far pieces lie beyond the box of the samples, in its extents.
/// Result: false where float32 has no such grid, the curve being far from the origin for its size.
bool choose_grid(curve::Head& head, float beyond = 0);

/// The tree of runs: split at the median across the widest axis by (middle of the run's box, run),
/// a total order, so the same tree on every machine; boxes rounded outward to the head's grid.
/// Cost: O(n log n), about 0.1 s for 2,000,000 samples.
CurveRuns build_curve_runs(const std::vector<curve::Sample>& samples, const curve::Head& head);

}  // namespace firmtouch::tools
