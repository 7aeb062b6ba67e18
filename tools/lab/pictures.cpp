#include "lab/pictures.hpp"

namespace firmtouch::lab {
namespace {

bool is_spline(const std::string& path) {
  const std::string ending =
      path.substr(path.rfind('.') == path.npos ? path.size() : path.rfind('.'));
  return ending == ".bpt" || ending == ".igs" || ending == ".iges";
}

}  // namespace

// The papers' figures as SVG, into the folder of --figures: of the models given, or of generated
// ones.
void run_pictures(const Options& options, Report& report) {
  Options splines = options, meshes = options;
  splines.models.clear(), meshes.models.clear();
  for (const std::string& path : options.models)
    (is_spline(path) ? splines : meshes).models.push_back(path);
  for (Options* drawn : {&splines, &meshes})
    if (drawn->figures.empty()) drawn->figures = ".";
  draw_critical_figures(splines, report);
  draw_spline_figures(splines, report);
  draw_curve_figures(meshes, report);
  draw_hull_figures(meshes, report);
}

}  // namespace firmtouch::lab
