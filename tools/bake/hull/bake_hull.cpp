#include "bake/hull/bake_hull.hpp"

#include "bake/asset/asset_views.hpp"
#include "bake/asset/probes.hpp"
#include "bake/hull/hull_encoder.hpp"

namespace firmtouch::tools {
namespace {

Surface surface_of(const mesh::View& mesh) {
  Surface surface;
  for (uint32_t i = 0; i < mesh.vertices().size(); ++i) surface.vertices.push_back(mesh.vertex(i));
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    surface.faces.push_back({t.corner[0], t.corner[1], t.corner[2]});
    surface.source.push_back(i);
  }
  return surface;
}

}  // namespace

std::vector<Section> bake_hull(const mesh::View& mesh, const std::vector<Section>& sections,
                               const std::string& name, const HullOptions& options,
                               HullBakeReport& report) {
  if (!mesh.is_signed()) {
    report.problem =
        "a hull needs a closed surface: bake without --unsigned or without --hull-faces";
    return {};
  }
  const Surface surface = surface_of(mesh);
  HullReport built;
  const ProgressiveHull hull = build_hull(surface, options, built);
  report.stalled = built.stalled;
  report.faces = hull.min_faces();
  report.collapses = static_cast<uint32_t>(hull.collapses.size());
  const double before = enclosed_volume_m3(surface),
               after = enclosed_volume_m3(hull_after(hull, report.collapses));
  report.void_percent = 100 * (after - before) / before;
  HullEncoder encoder(hull, mesh);
  report.problem = encoder.problem();
  if (!report.problem.empty()) return {};
  std::vector<Section> baked = encoder.run(name);
  for (const Section& s : baked) {
    const uint32_t bytes = static_cast<uint32_t>(s.bytes.size());
    (s.type == hull::kStarBoxesSection  ? report.star_bytes
     : s.type == hull::kBoxesSection    ? report.box_bytes
     : s.type == hull::kBaseHullSection ? report.base_hull_bytes
                                        : report.other_bytes) += bytes;
  }
  if (report.base_hull_bytes == 0) {
    report.problem = "a hull of " + std::to_string(report.faces) +
                     " faces is too fine for a shell, which numbers " +
                     std::to_string(hull::kMaxBaseHullVertices) + " vertices: request fewer faces";
    return {};
  }
  std::vector<Section> all = sections;
  all.insert(all.end(), baked.begin(), baked.end());
  hull::View view;
  const core::Verdict verdict = open_baked(all, name, view);
  if (!verdict.ok()) {
    report.problem =
        "the hull fails its own proof, " + rule_text(verdict) + "; please report this model";
    return {};
  }
  baked.push_back(hull_probes(view, name));
  return baked;
}

}  // namespace firmtouch::tools
