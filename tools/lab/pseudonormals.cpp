#include <cmath>

#include "bake/mesh/sign_margin.hpp"
#include "bake/mesh/stars.hpp"
#include "bench/models.hpp"
#include "lab/paper_figures.hpp"
#include "lab/reference_normals.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

using tools::Point;

struct Wrong {
  uint32_t vertices = 0;         // that can be a closest point, away from crossings
  std::vector<uint32_t> counts;  // of them, with a wrong sign for some point: for each kind
};

// Every extreme ray, drawn a little into the cone of those on its side.
std::vector<tools::SideRay> inner_rays(std::vector<tools::SideRay> rays) {
  Point middle[2];
  for (const tools::SideRay& ray : rays) {
    Point& sum = middle[ray.side > 0 ? 1 : 0];
    sum = sum + ray.direction;
  }
  for (tools::SideRay& ray : rays) {
    const Point sum = middle[ray.side > 0 ? 1 : 0];
    ray.direction = ray.direction + sum * (0.05 / length(sum));
  }
  return rays;
}

Wrong count_wrong(const Model& model) {
  const tools::Surface& surface = model.surface;
  const tools::ExactNormals exact(surface);
  const tools::Stars stars(surface, exact);
  const std::vector<std::vector<Corner>> corners = corners_of(surface);
  std::vector<bool> skipped(surface.vertices.size(), false);
  for (const tools::Crossings::Place& place : model.report.signs.crossings.places)
    for (const uint32_t v : place.vertices) skipped[v] = true;
  Wrong wrong;
  wrong.counts.resize(reference_normals().size());
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    const std::vector<tools::SideRay> rays = inner_rays(extreme_rays(stars.around(v)));
    if (skipped[v] || rays.empty()) continue;
    ++wrong.vertices;
    for (size_t k = 0; k < wrong.counts.size(); ++k) {
      for (const tools::SideRay& ray : rays) {
        const Point n = reference_normal(reference_normals()[k].kind, corners[v], ray.direction);
        if (dot(n, ray.direction) * ray.side > 0) continue;
        ++wrong.counts[k];
        break;
      }
    }
  }
  return wrong;
}

std::vector<std::string> heads(const char* what, const char* beside) {
  std::vector<std::string> all{what, beside};
  for (const NamedNormal& normal : reference_normals()) all.push_back(normal.name);
  return all;
}

void report_figures(Report& report) {
  report.heading("the side of one point beside the counterexamples of the paper");
  std::vector<std::vector<std::string>> rows;
  for (const PaperFigure& figure : paper_figures()) {
    const std::vector<Corner> corners = corners_of(figure.surface)[0];
    const Point r = figure.query - tools::to_point(figure.surface.vertices[0]);
    std::vector<std::string> row{figure.name, std::to_string(corners.size())};
    for (const NamedNormal& normal : reference_normals())
      row.push_back(dot(reference_normal(normal.kind, corners, r), r) > 0 ? "right" : "wrong");
    rows.push_back(row);
  }
  report.table(heads("figure", "faces"), rows);
}

}  // namespace

// The pseudonormals of section 2.1 of Baerentzen & Aanaes on their figures and on models: for how
// many vertices each gives a wrong sign for some point whose closest point is that vertex.
void run_pseudonormals(const Options& options, Report& report) {
  report_figures(report);
  report.heading("vertices that give a wrong sign for some point nearest to them");
  std::vector<std::vector<std::string>> rows;
  for (const Model& model : load_models(options)) {
    report.stage("pseudonormals of " + model.name);
    const Wrong wrong = count_wrong(model);
    std::vector<std::string> row{model.name, std::to_string(wrong.vertices)};
    for (const uint32_t count : wrong.counts) row.push_back(std::to_string(count));
    rows.push_back(row);
    report.bar("wrong vertices, angle-weighted", model.name, wrong.counts[0], "", 0);
  }
  report.table(heads("model", "vertices"), rows);
}

}  // namespace firmtouch::lab
