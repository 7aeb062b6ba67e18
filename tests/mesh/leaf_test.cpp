// Triangles of a leaf: excluding some that are certainly farther changes no bit.
#include "firmtouch/mesh/leaf.hpp"

#include "harness/test.hpp"
#include "random_leaf.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

struct Compared {
  uint32_t differ = 0, improved = 0;
};

}  // namespace

// All triangles, and without those that are certainly farther, from one bound; with indices of a
// known width and of either.
TEST(ExcludedTriangles_ChangeNoBitOfALeaf) {
  Compared compared;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    const Leaf leaf(turn);
    mesh::Sought all;
    all.p_m = leaf.p_m;
    all.slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
    all.vertices = leaf.vertices;
    all.triangles = leaf.triangles;
    const mesh::Foot any = closest_on(leaf, random_bits() % kTriangles);
    all.best.distance2_m2 = turn % 3 == 0 ? FLT_MAX : any.distance2_m2;
    mesh::Sought nearer = all;
    const uint32_t count = 1 + turn % 7;
    const uint32_t child = mesh::make_leaf(random_bits() % (kTriangles - count + 1), count);
    mesh::Sought of_any_width = all, nearer_of_any_width = all;
    mesh::Triangle<uint32_t> wide[kTriangles];
    for (uint32_t t = 0; t < kTriangles; ++t)
      for (uint32_t k = 0; k < 3; ++k) wide[t].corner[k] = leaf.triangles[t].corner[k];
    of_any_width.is_narrow = nearer_of_any_width.is_narrow = turn % 2 == 0;
    if (turn % 2 != 0) of_any_width.triangles = nearer_of_any_width.triangles = wide;
    mesh::measure_triangles<mesh::LeafCorners<uint16_t>, mesh::Everything>(child, 5, all);
    mesh::measure_triangles<mesh::LeafCorners<uint16_t>, mesh::Nearer>(child, 5, nearer);
    mesh::measure_triangles<mesh::LeafTriangles, mesh::Everything>(child, 5, of_any_width);
    mesh::measure_triangles<mesh::LeafTriangles, mesh::Nearer>(child, 5, nearer_of_any_width);
    compared.differ += same(all.best, nearer.best) ? 0u : 1u;
    compared.differ += same(all.best, of_any_width.best) ? 0u : 1u;
    compared.differ += same(all.best, nearer_of_any_width.best) ? 0u : 1u;
    compared.improved += all.best.slot == 5 ? 1u : 0u;
  }
  CHECK_EQ(compared.differ, 0u);
  CHECK(compared.improved > 8000u);
}
