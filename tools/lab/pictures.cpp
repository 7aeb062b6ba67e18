#include "lab/spline_pictures.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {

// The papers' figures as SVG, into the folder of --figures.
void run_pictures(const Options& options, Report& report) {
  Options drawn = options;
  if (drawn.figures.empty()) drawn.figures = ".";
  draw_spline_figures(drawn, report);
}

}  // namespace firmtouch::lab
