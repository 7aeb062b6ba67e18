#include "firmtouch/sections.hpp"

namespace firmtouch {

mesh::Sections mesh_sections(const asset::Container& container, const char* name) {
  mesh::Sections sections;
  sections.head = container.find(mesh::kHeadSection, name);
  sections.vertices = container.find(mesh::kVerticesSection, name);
  sections.triangles16 = container.find(mesh::kTriangles16Section, name);
  sections.triangles32 = container.find(mesh::kTriangles32Section, name);
  sections.nodes = container.find(mesh::kNodesSection, name);
  sections.parents = container.find(mesh::kParentsSection, name);
  sections.vertex_normals = container.find(mesh::kVertexNormalsSection, name);
  sections.edge_folds = container.find(mesh::kEdgeFoldsSection, name);
  sections.leaf_boxes = container.find(mesh::kLeafBoxesSection, name);
  sections.shapes = container.find(mesh::kShapesSection, name);
  return sections;
}

field::Sections distance_field_sections(const asset::Container& container, const char* name) {
  field::Sections sections;
  sections.head = container.find(field::kHeadSection, name);
  sections.distances = container.find(field::kDistancesSection, name);
  sections.seeds = container.find(field::kSeedsSection, name);
  return sections;
}

hull::Sections hull_sections(const asset::Container& container, const char* name) {
  hull::Sections sections;
  sections.head = container.find(hull::kHeadSection, name);
  sections.vertices = container.find(hull::kVerticesSection, name);
  sections.origins = container.find(hull::kOriginsSection, name);
  sections.records = container.find(hull::kRecordsSection, name);
  sections.places = container.find(hull::kPlacesSection, name);
  sections.star_boxes = container.find(hull::kStarBoxesSection, name);
  sections.boxes = container.find(hull::kBoxesSection, name);
  sections.base_hull = container.find(hull::kBaseHullSection, name);
  sections.mesh_head = container.find(mesh::kHeadSection, name);
  sections.mesh_vertices = container.find(mesh::kVerticesSection, name);
  sections.triangles16 = container.find(mesh::kTriangles16Section, name);
  sections.triangles32 = container.find(mesh::kTriangles32Section, name);
  return sections;
}

curve::Sections curve_sections(const asset::Container& container, const char* name) {
  curve::Sections sections;
  sections.head = container.find(curve::kHeadSection, name);
  sections.samples = container.find(curve::kSamplesSection, name);
  sections.arcs = container.find(curve::kArcsSection, name);
  sections.places = container.find(curve::kPlacesSection, name);
  sections.boxes = container.find(curve::kBoxesSection, name);
  sections.runs = container.find(curve::kRunsSection, name);
  sections.radii = container.find(curve::kRadiiSection, name);
  return sections;
}

spline::Sections spline_sections(const asset::Container& container, const char* name) {
  spline::Sections sections;
  sections.head = container.find(spline::kHeadSection, name);
  sections.pieces = container.find(spline::kPiecesSection, name);
  sections.coefficients = container.find(spline::kCoefficientsSection, name);
  sections.leaves = container.find(spline::kLeavesSection, name);
  sections.bends = container.find(spline::kBendsSection, name);
  sections.nodes = container.find(spline::kNodesSection, name);
  sections.points = container.find(spline::kPointsSection, name);
  sections.grids = container.find(spline::kGridsSection, name);
  sections.radii = container.find(spline::kRadiiSection, name);
  return sections;
}

spline::GuideSections guide_sections(const asset::Container& container, const char* name) {
  spline::GuideSections sections;
  sections.arcs = container.find(spline::kArcsSection, name);
  sections.chains = container.find(spline::kChainsSection, name);
  return sections;
}

}  // namespace firmtouch
