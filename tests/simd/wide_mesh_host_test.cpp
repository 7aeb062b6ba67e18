// The wide search of every level that this processor has gives the scalar search's answers, visits
// and hints, to the bit.

#include "../mesh/cube.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "simd/prism.hpp"
#include "simd/wide_mesh.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file

struct Baked {
  std::vector<tools::Section> sections;
  mesh::View view;

  explicit Baked(const tools::TreeShape& shape, bool is_signed = true)
      : Baked(tools::make_part(3, 3000), shape, is_signed) {}
  Baked(const tools::Surface& surface, const tools::TreeShape& shape, bool is_signed = true) {
    tools::MeshOptions options;
    options.is_signed = is_signed;
    options.shape = shape;
    options.max_growth = 0;  // as given: what is refined has fewer rivals
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "part", options, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "part", view).ok());
  }
  // As a mesh of more than 65,536 vertices.
  void take_indices_of_32_bits() {
    for (tools::Section& section : sections) {
      if (section.type != mesh::kTriangles16Section) continue;
      std::vector<uint16_t> narrow(section.bytes.size() / sizeof(uint16_t));
      memcpy(narrow.data(), section.bytes.data(), section.bytes.size());
      const std::vector<uint32_t> wide(narrow.begin(), narrow.end());
      section = tools::make_section(mesh::kTriangles32Section, section.name, wide);
    }
    CHECK(tools::open_baked(sections, "part", view).ok());
    CHECK(view.triangles16().empty());
  }
};

// Near the surface and far from it, one after the other in short steps and in long ones.
std::vector<query::ProbePoint> points_about(const mesh::Head& head, uint64_t seed) {
  tools::Random random(seed);
  std::vector<query::ProbePoint> points;
  const double size = static_cast<double>(head.diagonal_m);
  double at[3] = {0, 0, 0};
  for (uint32_t i = 0; i < 20000; ++i) {
    const double step = i % 50 == 0 ? 0.7 : 0.002;
    for (uint32_t k = 0; k < 3; ++k) {
      const double low = static_cast<double>(head.low_m[k]);
      const double high = static_cast<double>(head.high_m[k]);
      at[k] += random.between(-step, step) * size;
      if (at[k] < low - 0.1 * size || at[k] > high + 0.1 * size) at[k] = (low + high) / 2;
    }
    points.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
  }
  return points;
}

bool is_same(const mesh::Closest& a, const mesh::Closest& b) {
  const auto same = [](float x, float y) { return math::bits_of(x) == math::bits_of(y); };
  return same(a.distance_m, b.distance_m) && same(a.point_m.x, b.point_m.x) &&
         same(a.point_m.y, b.point_m.y) && same(a.point_m.z, b.point_m.z) &&
         same(a.direction.x, b.direction.x) && same(a.direction.y, b.direction.y) &&
         same(a.direction.z, b.direction.z) && a.triangle == b.triangle && a.feature == b.feature &&
         same(a.certificate.lower_m, b.certificate.lower_m) &&
         a.certificate.steps == b.certificate.steps && a.certificate.exact == b.certificate.exact &&
         a.certificate.sign == b.certificate.sign;
}

// They take turns with one hint: each reads what the other left.
uint32_t differences(const mesh::View& view, const simd::WideMesh& wide, query::Budget budget,
                     uint64_t seed) {
  mesh::Hint hint;
  uint32_t differ = 0, turn = 0;
  for (const query::ProbePoint& p : points_about(view.head(), seed)) {
    const math::Vec3 p_m{p.x_m, p.y_m, p.z_m};
    if (++turn % 3 == 0) hint = {};
    mesh::Hint other = hint;
    const mesh::Closest a = mesh::closest_point(view, p_m, budget, turn % 2 == 0 ? hint : other);
    const mesh::Closest b = wide.closest_point(p_m, budget, turn % 2 == 0 ? other : hint);
    differ += is_same(a, b) && hint.leaf_slot == other.leaf_slot &&
                      hint.safe_subtree == other.safe_subtree &&
                      hint.triangle_low == other.triangle_low
                  ? 0u
                  : 1u;
  }
  return differ;
}

uint32_t differences_at_levels(const mesh::View& view, query::Budget budget, uint64_t seed) {
  uint32_t differ = 0;
  for (const firmtouch_simd::Level& level : firmtouch_simd::levels())
    differ += differences(view, simd::WideMesh(view, level), budget, seed);
  return differ;
}

uint32_t triangles_in_blocks(const mesh::View& view) {
  const simd::OwnedTree owned(view);
  const simd::WideTree& tree = owned.tree();
  uint32_t in_blocks = 0;
  for (uint32_t node = 0; node < view.nodes().size(); ++node) {
    const uint32_t parent = mesh::slot_of(view.parents()[node]);
    if (node == 0 || tree.block_nodes[parent / 2].side[parent % 2].child < simd::kBlockBit)
      continue;
    const simd::NodeBlock block = tree.block(node);
    in_blocks += block.of.count;
    CHECK(node != 0 && block.of.count <= simd::kLanes);
    uint32_t lanes = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      CHECK_EQ(lanes & (block.lanes >> (8 * i)) & 0xFFu, 0u);
      lanes |= (block.lanes >> (8 * i)) & 0xFFu;
    }
    CHECK_EQ(lanes, (1u << block.of.count) - 1u);
    const mesh::Side* const sides = view.sides() + 2 * node;
    uint32_t boxes = 0x11u;
    if (!mesh::is_leaf(sides[0].child)) boxes |= 0x22u;
    if (!mesh::is_leaf(sides[1].child)) boxes |= 0x44u;
    CHECK_EQ(block.boxes, boxes);
  }
  return in_blocks;
}

}  // namespace

TEST(EveryLevel_HasTheBitsOfTheScalarSearch) {
  const tools::TreeShape shapes[] = {
      tools::kFastTree, tools::kSmallTree, tools::kBoundedTree, tools::kDesktopTree, {1}};
  uint64_t seed = 9;
  for (const tools::TreeShape& shape : shapes) {
    const Baked baked(shape, shape.leaf_faces != 7);
    for (const query::Budget budget :
         {query::kUnlimited, query::Budget{12}, query::Budget{UINT32_MAX, 0.05f}})
      CHECK_EQ(differences_at_levels(baked.view, budget, seed++), 0u);
  }
}

TEST(EveryLevel_HasTheBitsOfTheScalarSearch_IndicesOf32Bits) {
  for (const tools::TreeShape& shape : {tools::kFastTree, tools::kBoundedTree}) {
    Baked baked(shape);
    baked.take_indices_of_32_bits();
    for (const query::Budget budget :
         {query::kUnlimited, query::Budget{12}, query::Budget{UINT32_MAX, 0.05f}})
      CHECK_EQ(differences_at_levels(baked.view, budget, 14), 0u);
  }
}

// Their nearest triangles have rivals (mesh/leaf.hpp).
TEST(EveryLevel_HasTheBitsOfTheScalarSearch_MachinedParts) {
  // By twos: each kind, askew or not, by either bake.
  for (uint64_t seed = 0; seed < 2 * tools::kCadKinds; seed += test::is_long() ? 1u : 2u) {
    test::note("seed", static_cast<int64_t>(seed));
    const Baked baked(tools::to_surface(tools::make_cad(seed)),
                      seed % 3 == 0 ? tools::kBoundedTree : tools::kFastTree);
    CHECK(baked.view.has_rivals());
    for (const query::Budget budget :
         {query::kUnlimited, query::Budget{12}, query::Budget{UINT32_MAX, 0.05f}})
      CHECK_EQ(differences_at_levels(baked.view, budget, seed), 0u);
  }
}

TEST(EveryLevel_HasTheBitsOfTheScalarSearch_OneTriangle) {
  tools::Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.faces = {{0, 1, 2}};
  tools::MeshOptions options;
  options.is_signed = false;
  tools::MeshReport report;
  const std::vector<tools::Section> sections = tools::bake_mesh(surface, "one", options, report);
  mesh::View view;
  CHECK(tools::open_baked(sections, "one", view).ok());
  CHECK_EQ(differences_at_levels(view, query::kUnlimited, 3), 0u);
}

// Breadth first, the triangles of a node are not consecutive: then it has no block.
TEST(EveryLevel_HasTheBitsOfTheScalarSearch_AnyTreeOrder) {
  for (const bool is_breadth_first : {false, true}) {
    const mesh_test::Cube cube(1.0f, is_breadth_first);
    const mesh::View view = cube.view();
    CHECK_EQ(triangles_in_blocks(view), is_breadth_first ? 8u : 12u);
    CHECK_EQ(differences_at_levels(view, query::kUnlimited, 4), 0u);
  }
}

TEST(MostTrianglesOfABake_LieInBlocks) {
  for (const tools::TreeShape& shape : {tools::kFastTree, tools::TreeShape{1}}) {
    const Baked baked(shape);
    CHECK_LT(baked.view.head().triangle_count * 3 / 4, triangles_in_blocks(baked.view));
  }
}

TEST(EveryTriangle_IsStoredWhereItsLeafSays) {
  const Baked baked(tools::kFastTree);
  const simd::OwnedTree owned(baked.view);
  const simd::WideTree& tree = owned.tree();
  uint32_t seen = 0, differ = 0;
  for (uint32_t slot = 0; slot < 2 * baked.view.nodes().size(); ++slot) {
    const uint32_t leaf = tree.nodes[slot / 2].side[slot % 2].child;
    if (!mesh::is_leaf(leaf)) continue;
    const simd::Block block = simd::wide_leaf_block(leaf);
    for (uint32_t i = 0; i < mesh::leaf_count(leaf); ++i, ++seen) {
      const uint32_t triangle = simd::wide_leaf_first(leaf) + i;
      const mesh::Triangle<uint32_t> t = baked.view.triangle(triangle);
      const math::Vec3 corner[] = {baked.view.vertex(t.corner[0]), baked.view.vertex(t.corner[1]),
                                   baked.view.vertex(t.corner[2])};
      float shape[simd::kShapeArrays];
      simd::put_floats(simd::shape_of(corner[0], corner[1], corner[2]), shape);
      for (uint32_t row = 0; row < simd::kCornerArrays; ++row) {
        const math::Vec3& c = corner[row / 3];
        const float value = row % 3 == 0 ? c.x : row % 3 == 1 ? c.y : c.z;
        const float reported = tree.corners[simd::kCornerArrays * block.first + row * block.count +
                                            (triangle - block.first)];
        differ += math::bits_of(reported) == math::bits_of(value) ? 0u : 1u;
      }
      float prism[simd::kPrismArrays];
      simd::put_prism(corner[0], corner[1], corner[2], prism);
      for (uint32_t row = 0; row < simd::kPrismArrays; ++row) {
        const float reported = tree.prisms[simd::kPrismArrays * block.first + row * block.count +
                                           (triangle - block.first)];
        differ += math::bits_of(reported) == math::bits_of(prism[row]) ? 0u : 1u;
      }
      for (uint32_t row = 0; row < simd::kShapeArrays; ++row) {
        const float reported = tree.shapes[simd::kShapeArrays * block.first + row * block.count +
                                           (triangle - block.first)];
        differ += math::bits_of(reported) == math::bits_of(shape[row]) ? 0u : 1u;
      }
    }
  }
  CHECK_EQ(seen, baked.view.head().triangle_count);
  CHECK_EQ(differ, 0u);
}
