// Boxes of leaves (bake --bounded): never farther than the leaf they hold, near enough to be worth
// it, and of no weight in any answer.
#include "firmtouch/mesh/leaf_box.hpp"

#include <cfloat>
#include <cmath>
#include <cstring>

#include "bake/mesh/mesh_tree.hpp"
#include "baked_mesh.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "harness/test.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

tools::MeshOptions bounded() {
  tools::MeshOptions options;
  options.shape = tools::kBoundedTree;
  return options;
}

// Four large triangles: leaves as large as the model, so that offsets saturate.
tools::Surface tetrahedron() {
  tools::Surface surface;
  surface.vertices = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  surface.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return surface;
}

struct Reported {
  uint32_t leaves = 0, queries = 0, beyond = 0;
  double of_truth =
      0;  // share of the true distance, on average, where the leaf is about its size away
  uint32_t compared = 0;
  double of_box = 0;  // the same of the leaf's own box in the tree
};

double root(uint32_t square) { return std::sqrt(static_cast<double>(square)); }

// Each leaf against points about it, near by and anywhere in the grid.
Reported query_leaves(const BakedMesh& baked, uint32_t every) {
  Reported reported;
  tools::Random random(11);
  const mesh::View& view = baked.view;
  const double cell_m = double{view.head().cell_m};
  uint32_t number = 0;
  for (const mesh::Node& node : view.nodes())
    for (const mesh::Side& side : node.side) {
      if (!mesh::is_leaf(side.child) || mesh::leaf_count(side.child) < 2) continue;
      if (number++ % every != 0) continue;
      ++reported.leaves;
      const uint32_t first = mesh::leaf_first(side.child), count = mesh::leaf_count(side.child);
      const auto corner = [&](uint32_t t, uint32_t k) {
        return tools::to_point(view.vertex(view.triangle(t).corner[k]));
      };
      const Point middle = corner(first, 0);
      double size = 0;
      for (uint32_t t = first; t < first + count; ++t)
        for (uint32_t k = 0; k < 3; ++k) size = std::max(size, length(corner(t, k) - middle));
      for (uint32_t i = 0; i < 40; ++i) {
        const double reach = i % 4 == 0 ? 0.6 * baked.size : 2 * size;
        const Vec3 p_m{static_cast<float>(middle.x + random.between(-reach, reach)),
                       static_cast<float>(middle.y + random.between(-reach, reach)),
                       static_cast<float>(middle.z + random.between(-reach, reach))};
        mesh::NearBound bound;
        if (!bound.begin(view.head(), mesh::in_box_frame(view, p_m))) continue;
        double truth = DBL_MAX;
        for (uint32_t t = first; t < first + count; ++t)
          truth = std::min(
              truth, true_distance(tools::to_point(p_m), corner(t, 0), corner(t, 1), corner(t, 2)));
        const uint32_t* const box = view.leaf_boxes() + size_t{mesh::kLeafBoxStride} * first;
        const double lower = root(math::oriented_distance2(box, bound.half_cells()));
        ++reported.queries;
        if (lower * cell_m > truth) ++reported.beyond;
        if (i % 4 == 0 || truth < 0.5 * size) continue;
        ++reported.compared;
        reported.of_truth += lower * cell_m / truth;
        reported.of_box += root(bound.key(side.box)) * cell_m / truth;
      }
    }
  return reported;
}

bool same(const mesh::Closest& a, const mesh::Closest& b) {
  return std::memcmp(&a.distance_m, &b.distance_m, sizeof a.distance_m) == 0 &&
         std::memcmp(&a.point_m, &b.point_m, sizeof a.point_m) == 0 &&
         std::memcmp(&a.direction, &b.direction, sizeof a.direction) == 0 &&
         a.triangle == b.triangle && a.feature == b.feature &&
         std::memcmp(&a.certificate.lower_m, &b.certificate.lower_m, sizeof(float)) == 0 &&
         a.certificate.steps == b.certificate.steps && a.certificate.exact == b.certificate.exact &&
         a.certificate.sign == b.certificate.sign;
}

}  // namespace

TEST(LeafBoxBound_IsAtMostTheTrueDistance) {
  const BakedMesh part(tools::make_part(3, 3000), bounded());
  const Reported reported = query_leaves(part, 1);
  CHECK_LT(600u, reported.leaves);
  CHECK_EQ(reported.beyond, 0u);
  // What they are there for: without, leaves whose boxes lie within reach were measured in vain.
  CHECK_LT(0.93, reported.of_truth / reported.compared);
  CHECK_LT(reported.of_box / reported.compared + 0.05, reported.of_truth / reported.compared);
  const BakedMesh large(tetrahedron(), bounded());
  const Reported of_large = query_leaves(large, 1);
  CHECK_LT(0u, of_large.leaves);
  CHECK_EQ(of_large.beyond, 0u);
  for (uint64_t seed = tools::kCadKinds; seed < 2 * tools::kCadKinds; ++seed) {
    const BakedMesh askew(tools::to_surface(tools::make_cad(seed)), bounded());
    CHECK(askew.view.box_frame() != nullptr);
    CHECK_EQ(query_leaves(askew, 1).beyond, 0u);
  }
}

// Without a band all of it; with one what is nearer, and beyond it the lower bound.
// Result: how many answers of a band were beyond it.
static uint32_t beyond_where_boxes_change_nothing(const BakedMesh& baked) {
  mesh::Sections parts = baked.parts();
  CHECK(!parts.leaf_boxes.empty());
  parts.leaf_boxes = {};
  mesh::View without;
  CHECK(mesh::open(parts, without).ok());
  uint32_t differ = 0, beyond = 0;
  const std::vector<Vec3> queries = hard_queries(baked.surface, 2000, 8);
  for (const uint32_t steps : {1u, 8u, 64u, query::kUnlimited.work}) {
    const query::Budget budget{steps};
    mesh::Hint hint, other;
    for (const Vec3 p : queries)
      if (!same(mesh::closest_point(baked.view, p, budget, hint),
                mesh::closest_point(without, p, budget, other)))
        ++differ;
  }
  query::Budget budget;
  budget.band_m = static_cast<float>(0.01 * baked.size);
  for (const Vec3 p : queries) {
    mesh::Hint hint, other;
    const mesh::Closest a = mesh::closest_point(baked.view, p, budget, hint),
                        b = mesh::closest_point(without, p, budget, other);
    CHECK_EQ(a.certificate.exact, b.certificate.exact);
    CHECK_EQ(a.certificate.steps, b.certificate.steps);
    beyond += a.certificate.exact ? 0u : 1u;
    if (a.certificate.exact ? !same(a, b) : a.certificate.lower_m < b.certificate.lower_m) ++differ;
  }
  CHECK_EQ(differ, 0u);
  return beyond;
}

TEST(LeafBoxes_ChangeNoAnswer) {
  const BakedMesh part(tools::make_part(5, 3000), bounded());
  CHECK_LT(100u, beyond_where_boxes_change_nothing(part));
  const BakedMesh askew(tools::to_surface(tools::make_cad(tools::kCadKinds)), bounded());
  CHECK(askew.view.box_frame() != nullptr);
  CHECK_LT(100u, beyond_where_boxes_change_nothing(askew));
}

TEST(R137WordsBesideTheBoxes) {
  BakedMesh baked(tools::make_part(3, 3000), bounded());
  mesh::Sections parts = baked.parts();
  uint32_t* const words =
      const_cast<uint32_t*>(reinterpret_cast<const uint32_t*>(parts.leaf_boxes.data()));
  uint32_t single = 0, triple = 0;
  for (const mesh::Node& node : baked.view.nodes())
    for (const mesh::Side& side : node.side) {
      if (!mesh::is_leaf(side.child)) continue;
      const uint32_t first = mesh::leaf_first(side.child), count = mesh::leaf_count(side.child);
      if (count == 2 || (count == 1 ? single : triple)++ >= 3) continue;
      for (uint32_t i = count == 1 ? 0 : mesh::kLeafBoxWords; i < mesh::kLeafBoxStride * count;
           ++i) {
        uint32_t& word = words[mesh::kLeafBoxStride * first + i];
        word ^= 0x10000u;
        mesh::View view;
        const core::Verdict verdict = mesh::open(parts, view);
        CHECK_EQ(verdict.rule, 137u);
        CHECK_EQ(verdict.element, first);
        word ^= 0x10000u;
      }
    }
  CHECK_LT(0u, single);
  CHECK_LT(0u, triple);
}
