// A baked spline's foot-points are those of the file, but for the rounding of its coefficients.
#include "footpoint/asset_pieces.hpp"

#include <cmath>

#include "bake/bake_spline.hpp"
#include "footpoint/footpoints.hpp"
#include "harness/test.hpp"
#include "spline/sample_splines.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using tools::Footpoint;
using tools::Footpoints;

void same_as_baked(const tools::SplineModel& model, const Footpoints& source, uint64_t seed) {
  tools::SplineReport report;
  const auto detail =
      model.surfaces.empty() ? tools::curve_detail(false) : tools::surface_detail(true);
  const auto sections = tools::bake_spline(model, "a", detail, report);
  CHECK(report.problem.empty());
  spline::View view;
  CHECK(spline::open(tools::spline_sections(sections, "a"), view).ok());
  std::vector<tools::BezierCurve> curves;
  std::vector<tools::BezierPatch> patches;
  tools::asset_pieces(view, curves, patches);
  const Footpoints baked(curves, patches, tools::kAssetGap);
  CHECK_EQ(baked.corners().size(), source.corners().size());
  CHECK_GE(baked.borders().size(), source.borders().size());
  tools::Random random(seed);
  for (int k = 0; k < 20; ++k) {
    const tools::Point p{random.between(-0.2, 1.2), random.between(-0.2, 1.2),
                         random.between(-0.5, 0.5)};
    bool is_complete = false;
    const std::vector<Footpoint> a = source.all(p, is_complete), b = baked.all(p, is_complete);
    CHECK_EQ(a.size(), b.size());
    if (a.size() != b.size()) continue;
    for (size_t i = 0; i < a.size(); ++i) {
      CHECK_LE(std::fabs(a[i].distance_m - b[i].distance_m), 3e-7);
      CHECK_EQ(a[i].piece, b[i].piece);
    }
    CHECK_LE(std::fabs(a[0].u - b[0].u), 1e-3);
    CHECK_LE(std::fabs(a[0].v - b[0].v), 1e-3);
  }
}

}  // namespace

TEST(BakedCurvesHaveTheFootPointsOfTheirFile) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::SplineModel model;
    model.curves.push_back(tools::winding_curve(seed, 14, seed % 3 == 0, seed % 2 == 0));
    same_as_baked(model, {tools::bezier_pieces(model.curves[0]), {}}, seed);
  }
}

TEST(BakedSurfacesHaveTheFootPointsOfTheirFile) {
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    tools::SplineModel model;
    model.surfaces.push_back(tools::hilly_surface(seed, 5, 0.2, seed % 2 == 0));
    same_as_baked(model, {{}, tools::bezier_pieces(model.surfaces[0])}, seed);
  }
}
