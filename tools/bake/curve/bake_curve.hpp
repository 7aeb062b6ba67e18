#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "curve/curve_points.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::tools {

struct CurveReport {
  uint32_t samples = 0;
  uint32_t levels = 0;  // of the tree of runs
  bool is_closed = false;
  double length_m = 0;
  double shortest_segment_m = 0, longest_segment_m = 0;
  // Where smooth: how far from the curve of the file's decimals it may lie, because they are stored
  // as float32, and the step to blame: its row and length, and the piece beside it.
  double turned_m = 0, turned_step_m = 0, turned_piece_m = 0;
  uint32_t turned_row = 0;
  uint64_t bytes = 0;       // of all sections
  uint64_t tick_bytes = 0;  // of those that a tick reads
  std::string problem;      // empty: baked and proven; else what, where and how to mend
};

/// Builds tree and arc positions of a mended curve and proves them with the firmware's own open().
/// If rows were dropped, a section lists the row of each sample, for tools.
std::vector<Section> bake_curve(const CurvePoints& points, const std::string& name,
                                CurveReport& report);

}  // namespace firmtouch::tools
