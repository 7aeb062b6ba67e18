#pragma once
#include "curve/thin_run.hpp"

namespace firmtouch::tools {

/// Adds places of `run` to a thinned one until each cubic piece between samples and the run that it
/// stands for, joined place to place, lie within max_m of each other everywhere, either way.
/// Bounds: O(n log n) where the pieces follow the run; the same samples on every machine.
/// Result: points.problem names the place where even the places as they are give no such piece.
void refine_smooth_run(const std::vector<Place>& run, double max_m, const std::string& name,
                       ThinnedRun& thinned);

}  // namespace firmtouch::tools
