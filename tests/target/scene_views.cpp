#include "target/scene_views.hpp"

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/opening.hpp"

namespace firmtouch::target {
namespace {

core::Verdict open_mesh(const asset::Container& file, const char* name, mesh::View& view) {
  mesh::Sections sections;
  sections.head = file.find(mesh::kHeadSection, name);
  sections.vertices = file.find(mesh::kVerticesSection, name);
  sections.triangles16 = file.find(mesh::kTriangles16Section, name);
  sections.triangles32 = file.find(mesh::kTriangles32Section, name);
  sections.nodes = file.find(mesh::kNodesSection, name);
  sections.parents = file.find(mesh::kParentsSection, name);
  sections.vertex_normals = file.find(mesh::kVertexNormalsSection, name);
  sections.edge_folds = file.find(mesh::kEdgeFoldsSection, name);
  return mesh::open(sections, view);
}

core::Verdict open_curve(const asset::Container& file, const char* name, curve::View& view) {
  curve::Sections sections;
  sections.head = file.find(curve::kHeadSection, name);
  sections.samples = file.find(curve::kSamplesSection, name);
  sections.arcs = file.find(curve::kArcsSection, name);
  sections.places = file.find(curve::kPlacesSection, name);
  sections.boxes = file.find(curve::kBoxesSection, name);
  sections.runs = file.find(curve::kRunsSection, name);
  sections.radii = file.find(curve::kRadiiSection, name);
  return curve::open(sections, view);
}

core::Verdict open_spline(const asset::Container& file, const char* name, spline::View& view) {
  spline::Sections sections;
  sections.head = file.find(spline::kHeadSection, name);
  sections.pieces = file.find(spline::kPiecesSection, name);
  sections.coefficients = file.find(spline::kCoefficientsSection, name);
  sections.leaves = file.find(spline::kLeavesSection, name);
  sections.bends = file.find(spline::kBendsSection, name);
  sections.places = file.find(spline::kPlacesSection, name);
  sections.nodes = file.find(spline::kNodesSection, name);
  sections.points = file.find(spline::kPointsSection, name);
  sections.grids = file.find(spline::kGridsSection, name);
  sections.radii = file.find(spline::kRadiiSection, name);
  return spline::open(sections, view);
}

}  // namespace

Views open_views(core::Bytes region) {
  Views views;
  asset::Container file;
  const uint32_t bytes = asset::stated_bytes(region);
  views.verdict = asset::open({region.data(), bytes != 0 ? bytes : region.size()}, file);
  if (!views.verdict.ok()) return views;
  const uint32_t mesh = file.next_of_type(mesh::kHeadSection);
  if (mesh != asset::kNoSection) views.verdict = open_mesh(file, file.name(mesh), views.mesh);
  if (!views.verdict.ok()) return views;
  const uint32_t curve = file.next_of_type(curve::kHeadSection);
  if (curve != asset::kNoSection) views.verdict = open_curve(file, file.name(curve), views.curve);
  if (!views.verdict.ok()) return views;
  const uint32_t spline = file.next_of_type(spline::kHeadSection);
  if (spline != asset::kNoSection)
    views.verdict = open_spline(file, file.name(spline), views.spline);
  return views;
}

}  // namespace firmtouch::target
