// A baked spline's foot-points are those of the file, except for the rounding of its coefficients.
#include "footpoint/asset_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "bake/spline/bake_spline.hpp"
#include "footpoint/footpoints.hpp"
#include "harness/test.hpp"
#include "spline/read_spline.hpp"
#include "spline/sample_splines.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using tools::FootKind;
using tools::Footpoint;
using tools::Footpoints;

// The pieces that a baked model holds.
struct Baked {
  std::vector<tools::Section> sections;
  spline::View view;
  std::vector<tools::BezierCurve> curves;
  std::vector<tools::BezierPatch> patches;
  explicit Baked(const tools::SplineModel& model) {
    tools::SplineReport report;
    const auto detail =
        model.surfaces.empty() ? tools::curve_detail(false) : tools::surface_detail(true);
    sections = tools::bake_spline(model, "a", detail, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "a", view).ok());
    tools::asset_pieces(view, curves, patches);
  }
};

void same_as_baked(const tools::SplineModel& model, const Footpoints& source, uint64_t seed) {
  const Baked of_asset(model);
  const Footpoints baked(of_asset.curves, of_asset.patches, tools::kAssetGap);
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

// A pipe of radius 0.3 and length 0.5 about the z axis, of quarter circles.
tools::SplineModel pipe() {
  tools::SplineSurface s;
  s.degree_u = 2, s.degree_v = 1;
  s.count_u = 9, s.count_v = 2;
  s.knots_u = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  s.knots_v = {0, 0, 1, 1};
  s.u0 = s.v0 = 0;
  s.u1 = 4, s.v1 = 1;
  constexpr double kX[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, kY[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  for (const double z : {0.0, 0.5})
    for (size_t k = 0; k < 9; ++k)
      s.points.push_back({0.3 * kX[k], 0.3 * kY[k], z, k % 2 == 0 ? 1 : std::sqrt(0.5)});
  tools::SplineModel model;
  model.surfaces.push_back(s);
  return model;
}

// Rounding of the coefficients puts a foot-point there beyond the end of either patch.
TEST(NearACentreOfCurvature_TheNearestFootPointOnAJointIsFound) {
  tools::SplineModel torus =
      tools::read_spline_file(std::string(FIRMTOUCH_CAD_FILES) + "/torus.igs", 0);
  const Baked tube(torus), open(pipe());
  const Footpoints of_tube(tube.curves, tube.patches, tools::kAssetGap),
      of_pipe(open.curves, open.patches, tools::kAssetGap);
  CHECK(!of_pipe.borders().empty());
  constexpr double kEighth = 0.78539816339744831;
  for (const double off : {1e-4, 1e-5, 1e-6}) {
    for (int turn = 0; turn < 8; ++turn) {
      for (int roll = 0; roll < 8; ++roll) {
        const double c = std::cos(kEighth * turn), s = std::sin(kEighth * turn);
        const double ring = 0.05 + off * std::cos(kEighth * roll);
        bool is_complete = false;
        const Footpoint near =
            of_tube.all({ring * c, ring * s, off * std::sin(kEighth * roll)}, is_complete).front();
        CHECK_LE(std::fabs(near.distance_m - (0.02 - off)), 1e-7);
        CHECK(near.kind == FootKind::kMin);
        const double above = 0.1 * (roll - 1);  // beside the pipe, or beyond one of its ends
        const Footpoint rim = of_pipe.all({off * c, off * s, above}, is_complete).front();
        const double beyond = std::fmax(0, std::fmax(-above, above - 0.5));
        CHECK_LE(std::fabs(rim.distance_m - std::hypot(0.3 - off, beyond)), 3e-7);
      }
    }
  }
}

// Four patches around a pole, cubic about it: of each the edge v = 1 is one point.
tools::SplineModel dome() {
  constexpr double kBend = 0.5523;  // of a quarter circle's inner control points
  tools::SplineModel model;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double ux = quarter == 0 ? 1 : (quarter == 2 ? -1 : 0),
                 uy = quarter % 2 == 0 ? 0 : 2 - quarter;
    const double arc[4][2] = {{1, 0}, {1, kBend}, {kBend, 1}, {0, 1}};
    tools::SplineSurface s;
    s.degree_u = 3, s.degree_v = 2;
    s.count_u = 4, s.count_v = 3;
    s.knots_u = {0, 0, 0, 0, 1, 1, 1, 1};
    s.knots_v = {0, 0, 0, 1, 1, 1};
    s.u0 = s.v0 = 0;
    s.u1 = s.v1 = 1;
    s.piece = quarter;
    for (int row = 0; row < 3; ++row)
      for (const double* a : arc) {
        const double radius = row < 2 ? 0.5 : 0;
        s.points.push_back({0.3 + radius * (a[0] * ux - a[1] * uy),
                            0.7 + radius * (a[0] * uy + a[1] * ux), row == 0 ? 0.1 : 0.37, 1});
      }
    model.surfaces.push_back(s);
  }
  return model;
}

// Rounding of the baked coefficients makes a curve of about 1e-8 of the edge at the pole.
TEST(PatchesAtAPole_AreCutOnlyWhereTheirNeighboursAre) {
  const tools::SplineModel model = dome();
  const Baked baked(model);
  double narrowest = 1;
  for (const spline::Piece& piece : baked.view.pieces())
    narrowest = std::min(narrowest, 2 * static_cast<double>(piece.half_u));
  for (const tools::BezierPatch& patch : baked.patches)
    CHECK_GE(patch.u1 - patch.u0, narrowest * 0.999);
  bool is_complete = false;
  CHECK(!Footpoints(baked.curves, baked.patches, tools::kAssetGap)
             .all({0.2, 0.6, 1}, is_complete)
             .empty());
}

// A sheet of 1,000:1 whose weights draw its pieces together, until they are narrower than the gap.
TEST(PiecesNarrowerThanTheGap_AreNotCutWithoutEnd) {
  tools::SplineModel model;
  model.surfaces.push_back(tools::hilly_surface(3, 4, 0.3, false));
  tools::Random random(3);
  for (tools::ControlPoint& p : model.surfaces[0].points)
    p.y *= 1e-3, p.z *= 1e-3, p.w = std::pow(10, random.between(-2, 2));
  const Baked baked(model);
  CHECK_GT(baked.view.pieces().size(), 10u);
  CHECK_LE(baked.patches.size(), 16 * size_t{baked.view.pieces().size()});
}
