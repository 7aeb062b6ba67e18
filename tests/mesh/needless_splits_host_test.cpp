// Machined parts: triangles that queries gain nothing by are not made.
#include "bake/mesh/query_cost.hpp"
#include "baked_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_walk.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT

// Work units along a touching path that no bake is chosen by.
uint64_t work_on(const BakedMesh& part, const mesh::View& mesh) {
  mesh::Hint found, hint;
  uint64_t work = 0;
  for (const math::Vec3 p : tools::make_walk(part.surface, 7, 10000, [&](math::Vec3 at) {
         return mesh::closest_point(part.view, at, query::kUnlimited, found).point_m;
       }))
    work += mesh::closest_point(mesh, p, query::kUnlimited, hint).certificate.work;
  return work;
}

struct AllSplits {
  std::vector<tools::Section> sections;
  mesh::View view;

  explicit AllSplits(const tools::Surface& surface) {
    tools::MeshReport report;
    sections = tools::bake_mesh_so(surface, "all", {}, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "all", view).ok());
  }
};

tools::Surface cad(uint64_t seed) { return tools::to_surface(tools::make_cad(seed)); }

}  // namespace

TEST(NeedlessSplits_LongEdgesThatStayLong_AreLeftOut) {
  for (const uint64_t seed : {7u, 12u, 17u}) {
    test::note("seed", static_cast<int64_t>(seed));
    const BakedMesh part(cad(seed));
    const AllSplits all(part.surface);
    CHECK_EQ(part.view.head().triangle_count, part.surface.faces.size());
    CHECK_GT(all.view.head().triangle_count, part.surface.faces.size());
    CHECK(all.view.has_rivals());
    CHECK_LT(work_on(part, part.view), work_on(part, all.view));
  }
}

TEST(NeedlessSplits_SplitsThatMakeFloatsEnough_Stay) {
  const BakedMesh part(cad(20));
  CHECK_GT(part.view.head().triangle_count, part.surface.faces.size());
  CHECK(!part.view.has_rivals());
}

TEST(NeedlessSplits_OptionsWithoutSplits_AreReturnedAsTheyAre) {
  for (const double growth : {0.0, 1.0}) {
    tools::MeshOptions options;
    options.max_growth = growth;
    CHECK_EQ(tools::without_needless_splits(cad(12), options).max_growth, growth);
  }
  const tools::Surface nothing;
  CHECK_EQ(tools::without_needless_splits(nothing, {}).max_growth, tools::kMaxGrowth);
}
