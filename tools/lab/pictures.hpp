#pragma once
#include "lab/trials.hpp"

namespace firmtouch::lab {

// Each draws figures of one paper as SVG into the folder `options.figures` and throws a Problem
// where a file cannot be written.

/// Seong, Johnson, Cohen, figures 5 and 6: curve and evolute, the zero set with its critical curve,
/// surface and critical points, and the cells that list them. Evolute and critical points are drawn
/// as centres of curvature; tests/footpoint/tracker_host_test.cpp shows that the solver finds the
/// same. Figure 5c, the critical points solved for, is not drawn.
void draw_critical_figures(const Options& options, Report& report);
/// The same paper, figures 7 to 11: each of 200 positions of a path joined with the nearest point,
/// as the published method carries it along. Figure 11 shows the first spline model given, or two
/// surfaces.
void draw_spline_figures(const Options& options, Report& report);
/// Morris 2006, figure 3: device and constraint joined by lines, with and without a penalty.
void draw_curve_figures(const Options& options, Report& report);
/// Platis & Theoharis 2003, figures 6, 7 and 9 to 12: a mesh and its hulls of 2,000 and 200 faces,
/// by both strategies. Figure 8 is a table (`firmtouch-lab hulls`).
void draw_hull_figures(const Options& options, Report& report);

}  // namespace firmtouch::lab
