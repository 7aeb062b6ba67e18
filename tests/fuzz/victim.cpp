#include "fuzz/victim.hpp"

#include <string>

#include "bake/asset/asset_writer.hpp"
#include "bake/asset/probes.hpp"
#include "bake/asset/provenance.hpp"
#include "bake/curve/bake_curve.hpp"
#include "bake/field/bake_field.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/asset/layout.hpp"
#include "harness/test.hpp"

namespace firmtouch::fuzz {
namespace {

using tools::Section;

// A cube with a bump on each side: 24 triangles, folds of both directions.
tools::Surface pebble() {
  tools::Surface surface;
  for (int i = 0; i < 8; ++i) {
    surface.vertices.push_back(
        {(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 0.7f : -0.7f, (i & 4) != 0 ? 0.5f : -0.5f});
  }
  const uint32_t sides[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  for (uint32_t side = 0; side < 6; ++side) {
    const float out = side % 2 == 0 ? 1.3f : 0.8f;  // hills and dents
    math::Vec3 tip{0, 0, 0};
    for (const uint32_t corner : sides[side]) {
      const math::Vec3 v = surface.vertices[corner];
      tip = {tip.x + v.x * 0.25f, tip.y + v.y * 0.25f, tip.z + v.z * 0.25f};
    }
    surface.vertices.push_back({tip.x * out, tip.y * out, tip.z * out});
    for (uint32_t k = 0; k < 4; ++k) {
      surface.faces.push_back({sides[side][k], sides[side][(k + 1) % 4], 8 + side});
      surface.source.push_back(static_cast<uint32_t>(surface.source.size()));
    }
  }
  return surface;
}

void add_mesh(std::vector<Section>& sections, const std::string& name, bool is_signed, bool wide) {
  tools::MeshOptions options;
  options.is_signed = is_signed;
  options.shape = wide ? tools::kDesktopTree : is_signed ? tools::kFastTree : tools::kBoundedTree;
  tools::MeshReport report;
  std::vector<Section> mesh = tools::bake_mesh(pebble(), name, options, report);
  CHECK(report.problem.empty());
  for (Section& section : mesh) {
    if (!wide || section.type != mesh::kTriangles16Section) continue;
    Section widened{mesh::kTriangles32Section, name, {}};
    for (size_t i = 0; i < section.bytes.size(); i += 2) {
      for (const uint8_t byte : {section.bytes[i], section.bytes[i + 1], uint8_t{0}, uint8_t{0}}) {
        widened.bytes.push_back(byte);
      }
    }
    section = widened;
  }
  mesh::View view;
  CHECK(tools::open_baked(mesh, name, view).ok());
  // Only three cells a side: each proof queries the mesh for all of them.
  if (is_signed && !wide) {
    tools::FieldReport of_field;
    std::vector<Section> distance_field = tools::bake_field(view, name, 1, of_field);
    CHECK(of_field.problem.empty());
    for (size_t i = 8; i < distance_field[1].bytes.size();
         i += 2) {                     // four cells are proven, the others
      distance_field[1].bytes[i] = 0;  // say nothing: that takes no query
      distance_field[1].bytes[i + 1] = 0x80;
    }
    mesh.insert(mesh.end(), distance_field.begin(), distance_field.end());
  }
  mesh.push_back(tools::mesh_probes(view, name));
  mesh.push_back(tools::text_section(asset::kBoundsSection, name, {{"kind", "mesh"}}));
  sections.insert(sections.end(), mesh.begin(), mesh.end());
}

void add_curve(std::vector<Section>& sections, const std::string& name, bool closed) {
  tools::CurvePoints points;
  for (uint32_t i = 0; i < (closed ? 12u : 70u); ++i) {  // one run, two runs
    const float t = 0.2f * static_cast<float>(i);
    points.samples_m.push_back({0.1f * t, 0.02f * t * t, i % 3 == 0 ? 0.05f : 0.0f});
    points.rows.push_back(i < 5 ? i : i + 1);  // row 5 was dropped
  }
  if (closed) {
    points.samples_m.push_back(points.samples_m[0]);
    points.rows.push_back(13);
  }
  points.with_tree = true;
  tools::CurveReport report;
  std::vector<Section> curve = tools::bake_curve(points, name, report);
  CHECK(report.problem.empty());
  curve::View view;
  CHECK(tools::open_baked(curve, name, view).ok());
  curve.push_back(tools::curve_probes(view, name));
  sections.insert(sections.end(), curve.begin(), curve.end());
}

}  // namespace

std::vector<uint8_t> make_victim() {
  std::vector<Section> sections;
  add_mesh(sections, "pebble", true, false);
  add_mesh(sections, "wide", true, true);
  add_mesh(sections, "sheet", false, false);
  add_curve(sections, "track", false);
  add_curve(sections, "loop", true);
  sections.push_back(tools::text_section(asset::kProvenanceSection, "pebble",
                                         tools::provenance("pebble.obj", {1, 2, 3}, "", "tests")));
  sections.push_back({0x80000001u, "pebble", {1, 2, 3, 4, 5}});
  sections.push_back(
      tools::make_section(asset::kOriginSection, "origin", std::vector<float>{40, -3, 0.5f}));
  tools::AssetFile file = tools::write_asset(sections);
  CHECK(file.problem.empty());
  return file.bytes;
}

}  // namespace firmtouch::fuzz
