#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

#include "bench/models.hpp"
#include "hull/build_hull.hpp"
#include "lab/picture.hpp"
#include "lab/pictures.hpp"

namespace firmtouch::lab {
namespace {

using tools::Point;

// Faces from far to near, those that look away left out, lit from above the viewer's left shoulder.
void draw(const Options& options, const tools::Surface& surface, const Model& model,
          const std::string& name, Report& report) {
  const mesh::Head& head = model.view.head();
  Point low, high;
  const auto bound = [&](int k) {
    const double a = static_cast<double>(head.low_m[k]), b = static_cast<double>(head.high_m[k]);
    return std::make_pair(a - 0.05 * (b - a), b + 0.05 * (b - a));
  };
  std::tie(low.x, high.x) = bound(0), std::tie(low.y, high.y) = bound(1);
  std::tie(low.z, high.z) = bound(2);
  Picture picture(low, high, true);
  struct Shown {
    double depth, light;
    Point corners[3];
  };
  std::vector<Shown> shown;
  for (const tools::Face& face : surface.faces) {
    Shown each{};
    for (size_t k = 0; k < 3; ++k) each.corners[k] = tools::to_point(surface.vertices[face[k]]);
    const Point normal =
        cross(each.corners[1] - each.corners[0], each.corners[2] - each.corners[0]);
    if (!(picture.depth(normal) > 0)) continue;
    each.light = std::fmax(0, dot(normal, {-0.6, -0.5, 0.62})) / length(normal);
    each.depth = picture.depth(each.corners[0] + each.corners[1] + each.corners[2]);
    shown.push_back(each);
  }
  std::sort(shown.begin(), shown.end(),
            [](const Shown& a, const Shown& b) { return a.depth < b.depth; });
  for (const Shown& each : shown) {
    const int grey = static_cast<int>(70 + 180 * each.light);
    char style[120];
    std::snprintf(style, sizeof(style),
                  "fill=\"rgb(%d,%d,%d)\" stroke=\"#345\" stroke-width=\"%.2f\"", grey, grey,
                  std::min(255, grey + 8), surface.faces.size() > 5000 ? 0.08 : 0.35);
    picture.area({each.corners[0], each.corners[1], each.corners[2]}, style);
  }
  write_picture(options, name, picture, report);
}

}  // namespace

void draw_hull_figures(const Options& options, Report& report) {
  report.heading("progressive hulls, figures 6, 7 and 9 to 12: models and hulls, drawn into " +
                 options.figures);
  constexpr std::pair<tools::HullStrategy, const char*> kStrategies[] = {
      {tools::HullStrategy::kVolume, "-strategy-1-"},
      {tools::HullStrategy::kCentre, "-strategy-2-"}};
  for (const Model& model : load_models(options)) {
    report.stage("hulls of " + model.name);
    draw(options, model.surface, model, model.name + "-mesh", report);
    for (const auto& [strategy, name] : kStrategies) {
      tools::HullOptions how;
      how.strategy = strategy;
      how.target_faces = 200;
      tools::HullReport built;
      const tools::ProgressiveHull hull = tools::build_hull(model.surface, how, built);
      for (const uint32_t faces : {2000u, 200u})
        draw(options, tools::hull_level(hull, std::max(faces, hull.min_faces())), model,
             model.name + "-hull" + name + std::to_string(faces), report);
    }
  }
}

}  // namespace firmtouch::lab
