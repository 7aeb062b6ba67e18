#include <algorithm>
#include <cstdio>
#include <utility>

#include "bake/asset/probes.hpp"
#include "bake/asset/provenance.hpp"
#include "bake/asset/step_figures.hpp"
#include "bake/field/bake_field.hpp"
#include "bake/hull/bake_hull.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "cli/baked_input.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/version.hpp"
#include "firmtouch/asset/layout.hpp"
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/make/make_walk.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint64_t kWalkSeed = 1;

tools::StepFigures steps_of(const mesh::View& view, const tools::Surface& surface) {
  mesh::Hint hint;
  const auto query = [&](math::Vec3 p_m, bool cold) {
    if (cold) hint = mesh::Hint{};
    return mesh::closest_point(view, p_m, query::kUnlimited, hint);
  };
  const auto walk = tools::make_walk(surface, kWalkSeed, tools::kFigureQueries,
                                     [&](math::Vec3 p_m) { return query(p_m, false).point_m; });
  return tools::measure_steps(
      view.head().low_m, view.head().high_m, walk,
      [&](math::Vec3 p_m, bool cold) { return query(p_m, cold).certificate.steps; });
}

tools::Facts facts_of(const mesh::View& view, const tools::StepFigures& steps) {
  tools::Facts facts = {
      {"kind", view.is_signed() ? "mesh" : "mesh without inside and outside"},
      {"triangles", std::to_string(view.head().triangle_count)},
      {"vertices", std::to_string(view.head().vertex_count)},
      {"nodes", std::to_string(view.head().node_count)},
      {"depth", std::to_string(view.head().depth)},
      {"diagonal_m", tools::number_text(static_cast<double>(view.head().diagonal_m))}};
  add_steps(steps, facts);
  return facts;
}

std::string sentence(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof(text), format, a, b);
  return text;
}

double degrees(double rad) { return rad * 57.295779513082320; }

std::vector<std::string> report_of(const tools::MeshReport& report, const tools::Surface& surface,
                                   const tools::StepFigures& steps, uint64_t bytes,
                                   bool is_signed) {
  const double triangles = report.triangles;
  std::vector<std::string> lines = {
      "mesh, " + std::to_string(report.triangles) + " triangles, " +
          std::to_string(report.vertices) + " vertices, " +
          (is_signed ? "closed: inside and outside are known" : "unsigned: distance only"),
      std::to_string(bytes) + " bytes, " + std::to_string(report.shape_bytes + report.sign_bytes) +
          sentence(" of them for queries: a triangle %.1f for tree, indices and vertices, %.1f "
                   "for its side",
                   report.shape_bytes / triangles, report.sign_bytes / triangles),
      sentence("tree of depth %.0f (at most %.0f)", static_cast<double>(report.depth),
               static_cast<double>(mesh::kMaxDepth)),
      "RAM " + std::to_string(sizeof(mesh::Hint)) + " bytes a tool that touches it (mesh::Hint), " +
          std::to_string(sizeof(mesh::View)) + " for the view here; the asset stays in flash",
      is_signed
          ? sentence("every side proven on the stored normals: each could turn by "
                     "%.3g degrees more at edges, %.3g at vertices",
                     degrees(report.signs.edge_margin_rad), degrees(report.signs.vertex_margin_rad))
          : std::string("no normals of edges and vertices: sides are unknown"),
      sentence("steps at 2000 random points, each on its own: mean %.1f, worst seen %.0f",
               steps.random_mean, steps.random_worst),
      sentence("steps on a touching path of 2000 points: mean %.1f, worst seen %.0f",
               steps.path_mean, steps.path_worst)};
  if (report.refined.any())
    lines.push_back(
        "long triangles cut anew for faster queries (--keep-triangles: as in the file): " +
        std::to_string(surface.faces.size()) + " became " + std::to_string(report.triangles) +
        ", the surface moved by " + surface.frame.length_text(report.refined.moved_m) + " at most");
  return lines;
}

// Adds the sections of a distance field. Result: its line of the report.
std::string add_field(const mesh::View& view, const std::string& name, uint32_t cells,
                      const std::string& path, BakedInput& baked) {
  tools::FieldReport report;
  const std::vector<tools::Section> sections = tools::bake_field(view, name, cells, report);
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  baked.sections.insert(baked.sections.end(), sections.begin(), sections.end());
  const std::string grid = std::to_string(report.count[0]) + " x " +
                           std::to_string(report.count[1]) + " x " +
                           std::to_string(report.count[2]);
  return "distance field of " + grid + " cells" +
         sentence(" of %.4g m, bounds %.2g m apart at their centres", report.cell_m,
                  2 * report.quantum_m) +
         ", " + std::to_string(report.bytes) + " bytes" +
         (report.unknown == 0 ? "" : ", " + std::to_string(report.unknown) + " cells unknown");
}

// Adds the sections of a hull. Result: its line of the report.
std::vector<std::string> add_hull(const mesh::View& view, const std::string& name,
                                  const BakeOptions& options, const std::string& path,
                                  Progress& progress, BakedInput& baked) {
  progress.stage("collapsing edges of " + name, kShareOfHull);
  tools::HullOptions hull_options = options.hull;
  hull_options.on_progress = [&](uint32_t faces) {
    progress.stage(
        std::to_string(faces) + " faces left, of " + std::to_string(view.head().triangle_count), 0);
  };
  tools::HullBakeReport report;
  const std::vector<tools::Section> sections =
      tools::bake_hull(view, baked.sections, name, hull_options, report);
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  baked.sections.insert(baked.sections.end(), sections.begin(), sections.end());
  const double triangles = view.head().triangle_count;
  std::vector<std::string> reported{
      "progressive hull down to " + std::to_string(report.faces) + " faces, void " +
          sentence("%.3g %% of the volume, grid of %.0f bits", report.void_percent,
                   options.hull.grid_bits) +
          "; every new vertex proven outside in exact arithmetic",
      sentence("hull: a triangle %.1f bytes, and %.1f for boxes of stars,",
               report.other_bytes / triangles, report.star_bytes / triangles) +
          sentence(" %.1f for boxes over the triangles; coarsest hull %.0f bytes",
                   report.box_bytes / triangles, report.base_hull_bytes),
      "RAM of a refinement: " + std::to_string(4 * hull::bit_words(report.collapses)) +
          " bytes (a bit a collapse), 4 for each that may be split, 8 for each crossing kept"};
  if (!report.stalled.empty()) reported.push_back("hull " + report.stalled);
  return reported;
}

std::string line_of_materials(const tools::MeshReport& report, const tools::Materials& materials) {
  std::string line = "materials:";
  for (size_t i = 0; i < report.of_material.size(); ++i)
    line += (i == 0 ? "" : ",") + std::string(" ") + std::to_string(report.of_material[i]) +
            (i == 0 ? " triangles without" : " ") +
            (i == 0 ? "" : std::string(materials.table[i - 1].name));
  return line;
}

bool is_of_tree(uint32_t type) {
  return type == mesh::kNodesSection || type == mesh::kParentsSection ||
         type == mesh::kVertexNormalsSection || type == mesh::kEdgeFoldsSection ||
         type == mesh::kLeafBoxesSection;
}

const tools::TreeShape& tree_for(Purpose purpose) {
  switch (purpose) {
    case Purpose::kBounded:
      return tools::kBoundedTree;
    case Purpose::kSmall:
      return tools::kSmallTree;
    case Purpose::kDesktop:
      return tools::kDesktopTree;
    case Purpose::kFast:
      break;
  }
  return tools::kFastTree;
}

// What is left of a mesh for hull queries alone.
void drop_tree(BakedInput& baked) {
  auto& sections = baked.sections;
  sections.erase(std::remove_if(sections.begin(), sections.end(),
                                [](const tools::Section& s) { return is_of_tree(s.type); }),
                 sections.end());
}

}  // namespace

BakedInput bake_mesh_input(const std::string& path, const BakeOptions& options,
                           Progress& progress) {
  const std::string name = stem_of(path);
  BakedInput baked;
  progress.stage("reading and checking " + file_name_of(path), 0.3);
  std::vector<uint8_t> source = read_model(path);
  const tools::Section provenance = provenance_of(path, name, source, options.text);
  SoundSurface sound = sound_surface(path, std::move(source), options.model);

  progress.stage("building the tree of " + name, 0.65);
  tools::MeshOptions mesh_options;
  mesh_options.is_signed = options.model.is_signed;
  mesh_options.shape = tree_for(options.purpose);
  mesh_options.materials = options.model.materials.table;
  mesh_options.textures = options.model.materials.textures;
  mesh_options.reliefs = options.model.materials.reliefs;
  mesh_options.samples = options.model.materials.samples;
  if (options.purpose == Purpose::kSmall) mesh_options.max_growth = 1;
  if (options.keeps_triangles || !options.has_tree) mesh_options.max_growth = 0;
  tools::MeshReport report;
  baked.sections = tools::bake_mesh(sound.surface, name, mesh_options, report);
  if (!report.problem.empty() && options.model.mend && options.model.wrap.value > 0) {
    progress.stage("wrapping " + name, 0);
    const std::string problem = report.problem;
    ModelOptions wraps = options.model;
    wraps.mend = false;
    sound = sound_surface(path, read_model(path), wraps);
    sound.reported.push_back("mending alone was not enough: " + problem);
    report = {};
    baked.sections = tools::bake_mesh(sound.surface, name, mesh_options, report);
  }
  const tools::Surface& surface = sound.surface;
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  mesh::View view;
  const core::Verdict verdict = tools::open_baked(baked.sections, name, view);
  if (!verdict.ok()) fail_input(path + ": its mesh breaks rule R" + std::to_string(verdict.rule));

  std::string reported_of_field;
  if (options.field_cells != 0)
    reported_of_field = add_field(view, name, options.field_cells, path, baked);

  std::vector<std::string> reported_of_hull;
  if (options.hull_faces != 0)
    reported_of_hull = add_hull(view, name, options, path, progress, baked);
  const auto add_facts = [&](const tools::Facts& facts) {
    baked.sections.push_back(tools::text_section(asset::kBoundsSection, name, facts));
    baked.sections.push_back(provenance);
  };
  if (!options.has_tree) {
    drop_tree(baked);
    add_facts({{"kind", "mesh for hull queries alone"},
               {"triangles", std::to_string(view.head().triangle_count)},
               {"vertices", std::to_string(view.head().vertex_count)}});
    baked.report = {"mesh without a tree, " + std::to_string(report.triangles) + " triangles, " +
                    std::to_string(bytes_of(baked.sections)) +
                    " bytes: no distances, no touch, only queries of its hull"};
    baked.report.insert(baked.report.end(), reported_of_hull.begin(), reported_of_hull.end());
    baked.report.insert(baked.report.end(), sound.reported.begin(), sound.reported.end());
    return baked;
  }
  progress.stage("counting steps on " + name, 0.03);
  const tools::StepFigures steps = steps_of(view, surface);
  progress.stage("running the probes of " + name, 0.02);
  baked.sections.push_back(tools::mesh_probes(view, name));
  add_facts(facts_of(view, steps));
  baked.report =
      report_of(report, surface, steps, bytes_of(baked.sections), options.model.is_signed);
  if (!report.of_material.empty())
    baked.report.push_back(line_of_materials(report, options.model.materials));
  if (!reported_of_field.empty()) baked.report.push_back(reported_of_field);
  baked.report.insert(baked.report.end(), reported_of_hull.begin(), reported_of_hull.end());
  baked.report.insert(baked.report.end(), sound.reported.begin(), sound.reported.end());
  // Where a surface crosses itself no side is wrong; who touches it there should know.
  for (const std::string& line : tools::describe(report.signs, surface, sound.vertex_source))
    baked.report.push_back(line);
  return baked;
}

uint64_t bytes_of(const std::vector<tools::Section>& sections) {
  uint64_t bytes = 0;
  for (const tools::Section& section : sections) bytes += section.bytes.size();
  return bytes;
}

tools::Section provenance_of(const std::string& path, const std::string& name,
                             const std::vector<uint8_t>& source, const std::string& options) {
  return tools::text_section(asset::kProvenanceSection, name,
                             tools::provenance(file_name_of(path), source, options, kToolVersion));
}

}  // namespace firmtouch::cli
