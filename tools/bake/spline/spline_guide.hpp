#pragma once
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "firmtouch/spline/guide/view.hpp"

namespace firmtouch::tools {

struct SplineGuideReport {
  bool is_guide = false;  // what a controller can lead along
  double length_m = 0;
  uint32_t chains = 0, closed_chains = 0;
  uint32_t parts = 0;    // of a piece
  double arc_error = 0;  // of an arc position as the firmware returns it, of the length, as seen
  uint64_t bytes = 0;
};

/// Lengths along a proven model of curves, and which of its pieces follow each other.
/// Result: no sections where the firmware would not take them.
std::vector<Section> bake_spline_guide(const spline::View& model, const std::string& name,
                                       SplineGuideReport& report);

}  // namespace firmtouch::tools
