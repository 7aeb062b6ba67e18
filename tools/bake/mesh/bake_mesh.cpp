#include "bake/mesh/bake_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bake/mesh/box_frame.hpp"
#include "bake/mesh/leaf_boxes.hpp"
#include "bake/mesh/mesh_tree.hpp"
#include "bake/mesh/query_cost.hpp"
#include "bake/mesh/refine.hpp"
#include "bake/mesh/sign_proof.hpp"
#include "bake/mesh/turn_slivers.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "surface/check/mending.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// Half a unit in the last place of every coordinate: what reading them as float32 can have lost.
double import_rounding_m(const Surface& surface) {
  double largest2 = 0;
  for (const math::Vec3& v : surface.vertices) {
    double sum = 0;
    for (const float x : {v.x, v.y, v.z}) {
      if (!(std::fabs(x) > 0)) continue;
      int exponent = 0;
      std::frexp(x, &exponent);
      const double half = std::ldexp(1.0, exponent - 25);
      sum += half * half;
    }
    largest2 = std::max(largest2, sum);
  }
  return std::sqrt(largest2) * (1 + 0x1p-20);
}

// How far the surface may still move under a lower bound that holds for the model as imported.
double max_move_m(const Surface& surface) {
  return double{mesh::kMaxRounding} * (1 - 0x1p-18) * diagonal_m(surface.vertices) -
         import_rounding_m(surface);
}

mesh::Head make_head(const Surface& surface, const Grid& grid, const MeshTree& tree, bool is_signed,
                     double moved_m) {
  mesh::Head head{};
  head.vertex_count = static_cast<uint32_t>(surface.vertices.size());
  head.triangle_count = static_cast<uint32_t>(surface.faces.size());
  head.node_count = static_cast<uint32_t>(tree.nodes.size());
  head.depth = tree.depth;
  head.is_signed = is_signed ? 1 : 0;
  for (size_t k = 0; k < 3; ++k) {
    float low = surface.vertices[0].x, high = low;
    for (size_t v = 0; v < surface.vertices.size(); ++v) {
      const float values[3] = {surface.vertices[v].x, surface.vertices[v].y, surface.vertices[v].z};
      low = v == 0 ? values[k] : std::min(low, values[k]);
      high = v == 0 ? values[k] : std::max(high, values[k]);
    }
    head.low_m[k] = low;
    head.high_m[k] = high;
    head.grid_low_m[k] = grid.low_m[k];
  }
  head.diagonal_m = static_cast<float>(diagonal_m(surface.vertices) * (1 - 0x1p-21));
  head.cell_m = grid.cell_m;
  head.rounding_m =
      std::min(static_cast<float>(import_rounding_m(surface) + moved_m * (1 + 0x1p-20)),
               mesh::kMaxRounding * head.diagonal_m);
  for (const Face& f : surface.faces) {
    const float edge_m = math::length(surface.vertices[f[1]] - surface.vertices[f[0]]);
    head.longest_edge_m = std::max(head.longest_edge_m, edge_m);
  }
  return head;
}

struct Boxes {
  std::optional<mesh::BoxFrame> frame;
  Grid grid;
  MeshTree tree;
};

Boxes build_boxes(const Surface& surface, const std::optional<Frame>& turned,
                  const TreeShape& shape) {
  Boxes boxes;
  if (turned) boxes.frame = stored(*turned, surface);
  const Surface framed = turned ? in_box_frame(surface, *boxes.frame) : surface;
  boxes.grid = make_grid(framed);
  if (turned) boxes.grid.slack_cells = mesh::kTurnedSlackCells;
  boxes.tree = build_mesh_tree(framed, boxes.grid, shape);
  return boxes;
}

template <class Index>
std::vector<mesh::Triangle<Index>> make_triangles(const Surface& surface) {
  std::vector<mesh::Triangle<Index>> triangles;
  for (const Face& f : surface.faces)
    triangles.push_back(
        {{static_cast<Index>(f[0]), static_cast<Index>(f[1]), static_cast<Index>(f[2])}});
  return triangles;
}

// Faces in the order of the leaves, vertices in the order in which the faces first use them: what
// is near lies near.
struct Reordered {
  Surface surface;
  std::vector<uint32_t> vertex_from;  // of each vertex: its index before
};

Reordered in_leaf_order(const Surface& surface, const std::vector<uint32_t>& order) {
  constexpr uint32_t kUnseen = UINT32_MAX;
  Reordered result;
  Surface& sorted = result.surface;
  sorted.material = surface.material;
  std::vector<uint32_t> renamed(surface.vertices.size(), kUnseen);
  for (const uint32_t f : order) {
    Face face = surface.faces[f];
    for (uint32_t& corner : face) {
      if (renamed[corner] == kUnseen) {
        renamed[corner] = static_cast<uint32_t>(sorted.vertices.size());
        sorted.vertices.push_back(surface.vertices[corner]);
        result.vertex_from.push_back(corner);
      }
      corner = renamed[corner];
    }
    sorted.faces.push_back(face);
    sorted.source.push_back(f < surface.source.size() ? surface.source[f] : f);
  }
  return result;
}

void add_signs(const Pseudonormals& signs, const std::vector<uint32_t>& vertex_from,
               const std::vector<uint32_t>& face_from, const std::string& name,
               std::vector<Section>& sections) {
  std::vector<uint32_t> vertices;
  std::vector<mesh::EdgeFolds> edges;
  for (const uint32_t v : vertex_from) vertices.push_back(signs.vertices[v]);
  for (const uint32_t f : face_from) edges.push_back(signs.edges[f]);
  sections.push_back(make_section(mesh::kVertexNormalsSection, name, vertices));
  sections.push_back(make_section(mesh::kEdgeFoldsSection, name, edges));
}

void add_materials(const Surface& surface, const std::string& name, const MeshOptions& options,
                   MeshReport& report, std::vector<Section>& sections) {
  std::vector<uint8_t> triangles;
  report.of_material.assign(options.materials.size() + 1, 0);
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    triangles.push_back(surface.material_of(f));
    ++report.of_material.at(triangles.back());
  }
  sections.push_back(make_section(scene::kMaterialsSection, name, options.materials));
  sections.push_back(make_section(scene::kTriangleMaterialsSection, name, triangles));
  if (!options.textures.empty())
    sections.push_back(make_section(scene::kTexturesSection, name, options.textures));
  if (options.reliefs.empty()) return;
  sections.push_back(make_section(scene::kReliefsSection, name, options.reliefs));
  sections.push_back(make_section(scene::kReliefSamplesSection, name, options.samples));
}

// Whether nothing of a refined surface has to be reported by the faces of the file.
bool is_clear(const Surface& refined, const MeshReport& report) {
  if (!report.problem.empty() || !report.signs.crossings.pairs.empty()) return false;
  CheckReport contacts;
  refuse_contacts(refined, contacts);
  return contacts.usable();
}

std::string proof_failure(const core::Verdict& verdict) {
  if (verdict.rule == 128 || verdict.rule == 129)
    return "a triangle is too thin for float32; remove slivers with sides shorter than 1e-15 m or "
           "heights below 1e-10 of "
           "their length (rule R" +
           std::to_string(verdict.rule) + ")";
  return "the baked mesh fails its own proof, rule R" + std::to_string(verdict.rule) +
         " at element " + std::to_string(verdict.element) + "; please report this model";
}

}  // namespace

std::vector<Section> bake_mesh(const Surface& given, const std::string& name,
                               const MeshOptions& options, MeshReport& report) {
  return bake_mesh_so(given, name, without_needless_splits(given, options), report);
}

std::vector<Section> bake_mesh_so(const Surface& given, const std::string& name,
                                  const MeshOptions& options, MeshReport& report) {
  if (given.faces.size() > mesh::kMaxTriangles) {
    report.problem = std::to_string(given.faces.size()) + " triangles; at most " +
                     std::to_string(mesh::kMaxTriangles) + " fit an asset: simplify the model";
    return {};
  }
  Surface input = given;
  longest_edge_first(input);
  const std::optional<Frame> turned = best_box_frame(input);
  if (options.max_growth > 0)
    report.refined =
        refine(input, max_move_m(input) / 2, options.max_growth, turned.value_or(Frame{}));
  longest_edge_first(input);
  Pseudonormals signs;
  if (options.is_signed) {
    signs =
        bake_signs(input, max_move_m(input) - report.refined.moved_m, report.signs, report.problem);
    if (report.refined.any() && !is_clear(input, report)) {
      report = {};
      MeshOptions as_given = options;
      as_given.max_growth = 0;
      return bake_mesh_so(given, name, as_given, report);
    }
    if (!report.problem.empty()) return {};
  }
  const Boxes boxes = build_boxes(input, turned, options.shape);
  const Grid& grid = boxes.grid;
  const MeshTree& tree = boxes.tree;
  if (tree.depth > mesh::kMaxDepth) {
    report.problem = "the tree is " + std::to_string(tree.depth) + " levels deep, more than the " +
                     std::to_string(mesh::kMaxDepth) +
                     " that a query can hold: many triangles lie on one spot";
    return {};
  }
  const Reordered reordered = in_leaf_order(input, tree.order);
  const Surface& surface = reordered.surface;

  std::vector<Section> sections;
  const mesh::Head head = make_head(surface, grid, tree, options.is_signed,
                                    report.refined.moved_m + report.signs.turned.moved_m);
  std::vector<mesh::Vertex> vertices;
  for (const math::Vec3& v : surface.vertices) vertices.push_back({v.x, v.y, v.z});
  sections.push_back(make_section(mesh::kHeadSection, name, &head, 1));
  sections.push_back(make_section(mesh::kVerticesSection, name, vertices));
  if (vertices.size() <= 65536)
    sections.push_back(
        make_section(mesh::kTriangles16Section, name, make_triangles<uint16_t>(surface)));
  else
    sections.push_back(
        make_section(mesh::kTriangles32Section, name, make_triangles<uint32_t>(surface)));
  sections.push_back(make_section(mesh::kNodesSection, name, tree.nodes));
  sections.push_back(make_section(mesh::kParentsSection, name, tree.parents));
  if (boxes.frame) sections.push_back(make_section(mesh::kBoxFrameSection, name, &*boxes.frame, 1));
  if (options.shape.has_leaf_boxes) {
    const Surface framed = boxes.frame ? in_box_frame(surface, *boxes.frame) : surface;
    sections.push_back(
        make_section(mesh::kLeafBoxesSection, name, make_leaf_boxes(framed, grid, tree)));
  }
  for (const Section& s : sections) report.shape_bytes += static_cast<uint32_t>(s.bytes.size());
  if (options.is_signed) add_signs(signs, reordered.vertex_from, tree.order, name, sections);
  for (const Section& s : sections) report.sign_bytes += static_cast<uint32_t>(s.bytes.size());
  report.sign_bytes -= report.shape_bytes;
  sections.push_back(make_section(mesh::kSourceSection, name, surface.source));
  if (!options.materials.empty()) add_materials(surface, name, options, report, sections);
  report.triangles = head.triangle_count;
  report.vertices = head.vertex_count;
  report.nodes = head.node_count;
  report.depth = head.depth;

  mesh::View view;
  const core::Verdict verdict = open_baked(sections, name, view);
  if (!verdict.ok()) {
    report.problem = proof_failure(verdict);
    return {};
  }
  return sections;
}

}  // namespace firmtouch::tools
