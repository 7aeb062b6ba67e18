// The search that looks ahead finds what the one in turn finds, in as many steps.
#include "bake/mesh/bake_mesh.hpp"
#include "bake/mesh/mesh_ahead.hpp"
#include "firmtouch/mesh/nearest_ahead.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

mesh::Search begun(const mesh::View& view, Vec3 p_m, float band_m) {
  mesh::Search search{};
  search.p_m = p_m;
  search.start = query::kNowhere;
  search.budget = query::kUnlimited.steps;
  search.band2_m2 = band_m * band_m;
  search.best.offset_m = p_m - view.vertex(view.triangle(0).corner[0]);
  search.best.distance2_m2 = dot(search.best.offset_m, search.best.offset_m);
  return search;
}

bool is_same(const mesh::Search& a, const mesh::Search& b) {
  const auto same = [](float x, float y) { return math::bits_of(x) == math::bits_of(y); };
  return a.steps == b.steps && a.complete == b.complete && a.best.triangle == b.best.triangle &&
         a.best.slot == b.best.slot && a.best.feature == b.best.feature &&
         same(a.best.distance2_m2, b.best.distance2_m2) &&
         same(a.best.offset_m.x, b.best.offset_m.x) && same(a.best.offset_m.y, b.best.offset_m.y) &&
         same(a.best.offset_m.z, b.best.offset_m.z) && a.safe_subtree == b.safe_subtree;
}

// Points anywhere in the grid, on vertices, and on a coarse lattice, where keys are equal.
Vec3 point(const mesh::View& view, const tools::Surface& surface, uint32_t i,
           tools::Random& random) {
  if (i % 4 == 0)
    return surface.vertices[random.below(static_cast<uint32_t>(surface.vertices.size()))];
  const mesh::Head& head = view.head();
  float at[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const double low = static_cast<double>(head.low_m[k]),
                 high = static_cast<double>(head.high_m[k]);
    const double margin = 0.1 * (high - low);
    at[k] = static_cast<float>(random.between(low - margin, high + margin));
    if (i % 4 == 1) at[k] = static_cast<float>(static_cast<int>(at[k] * 20)) * 0.05f;
  }
  return {at[0], at[1], at[2]};
}

void compare(const tools::TreeShape& shape, uint64_t seed) {
  const tools::Surface surface = tools::make_part(3, 3000);
  tools::MeshOptions options;
  options.shape = shape;
  tools::MeshReport report;
  const std::vector<tools::Section> sections = tools::bake_mesh(surface, "part", options, report);
  mesh::View view;
  CHECK(mesh::open(tools::mesh_sections(sections, "part"), view).ok());
  const tools::MeshAhead made(view);
  const mesh::View lined = made.view();
  tools::Random random(seed);
  uint32_t differ = 0, found = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const Vec3 p_m = point(view, surface, i, random);
    mesh::NearBound bound;
    if (!bound.begin(view.head(), p_m)) continue;
    const float band_m = i % 5 == 0 ? 0.02f * view.head().diagonal_m : 1e15f;
    mesh::Search in_turn = begun(view, p_m, band_m), ahead = in_turn;
    mesh::search_nearest<false, mesh::NearBound, uint16_t>(view, bound, in_turn);
    mesh::search_ahead(lined, bound, ahead);
    if (!is_same(in_turn, ahead)) ++differ;
    found += ahead.best.slot != query::kNowhere ? 1 : 0;
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(2000u, found);
}

}  // namespace

TEST(LookingAheadFindsTheNearestThatTheSearchInTurnFinds) {
  if (!math::kHasLanes)
    return firmtouch::test::skip("built without vector instructions (preset host-native has them)");
  compare(tools::kFastTree, 1);
  compare(tools::kSmallTree, 2);
  compare(tools::kDesktopTree, 3);
  compare({1}, 4);
  compare({2}, 5);
}
