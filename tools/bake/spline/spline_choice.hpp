#pragma once
#include "bake/spline/bake_spline.hpp"

namespace firmtouch::tools {

/// Bakes a surface with bounds on larger and on smaller cells and keeps what answers a path through
/// its workspace with less work; anything else as bake_spline() does. Deterministic.
std::vector<Section> bake_fast_spline(const SplineModel& model, const std::string& name,
                                      bool is_small, SplineReport& report);

}  // namespace firmtouch::tools
