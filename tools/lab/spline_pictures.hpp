#pragma once
#include "lab/trials.hpp"

namespace firmtouch::lab {

/// Draws figures 7 to 11 of Seong, Johnson, Cohen as SVG into the folder `options.figures`: each of
/// 200 positions of a path joined with the nearest point, as the published method carries it along.
/// Figure 11 shows the first model given, or two surfaces. Throws a Problem where a file cannot
/// be written.
void draw_spline_figures(const Options& options, Report& report);

}  // namespace firmtouch::lab
