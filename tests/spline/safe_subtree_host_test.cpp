// What a query along a path keeps from the one before: where a safe subtree lets it pass over the
// rest of a curve, the answer is that of a query which knows nothing.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/curve/point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/surface/nodes.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/random_splines.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using query::kUnlimited;
using spline::Hint;
using spline_test::BakedModel;
using spline_test::of;

int most_of(uint32_t seed) { return static_cast<int>(1 + seed % 3); }
tools::SplineCurve flattened(tools::SplineCurve curve) {
  for (tools::ControlPoint& p : curve.points) p.z = 0;
  return curve;
}
// About x, by a quarter turn: y becomes z.
tools::SplineCurve lifted(tools::SplineCurve curve) {
  for (tools::ControlPoint& p : curve.points) p = {p.x, -p.z, p.y, p.w};
  return curve;
}

// Wanders about the curve's middle; often it goes back, now and then it jumps.
struct Path {
  tools::Random& random;
  double step, reach, at[3] = {0, 0, 0}, heading[3] = {0, 0, 0};

  Vec3 next() {
    if (random.below(10) == 0)
      for (double& h : heading) h = -h;
    for (int k = 0; k < 3; ++k) {
      heading[k] = 0.95 * heading[k] + 0.3 * random.bell();
      at[k] += step * heading[k];
      if (std::fabs(at[k]) > reach) {
        at[k] = std::copysign(reach, at[k]);
        heading[k] = -heading[k];
      }
      if (random.below(1500) == 0) at[k] = random.between(-reach, reach);
    }
    return {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
  }
};

// What queries along paths returned, beside each of them run cold.
struct Reported {
  uint32_t wrong = 0, inexact = 0,
           passed_over = 0;  // the latter: by a safe subtree, or a frontier, that stayed
};

void follow(const BakedModel& baked, tools::Random& random, int positions, Reported& reported) {
  const double unit = 2.1e-6 * baked.report.extent_m;
  for (const double step : {0.0002, 0.002, 0.02}) {
    Path path{random, step, 1.3};
    Hint hint;
    for (int i = 0; i < positions; ++i) {
      const Vec3 p = path.next();
      const uint32_t safe_subtree = hint.safe_subtree;
      const float unit_m = hint.frontier.unit_m;
      const spline::Closest warm = closest_point(baked.view, p, kUnlimited, hint);
      Hint cold;
      const spline::Closest alone = closest_point(baked.view, p, kUnlimited, cold);
      const double truth = double{alone.distance_m};
      reported.wrong += std::fabs(double{warm.distance_m} - truth) <= unit + 2e-6 * truth &&
                                double{warm.certificate.lower_m} <= truth
                            ? 0u
                            : 1u;
      reported.inexact += warm.certificate.exact ? 0u : 1u;
      const bool is_kept =
          baked.view.is_surface()
              ? unit_m > 0.0f && !(hint.frontier.unit_m < unit_m) &&
                    !(hint.frontier.unit_m > unit_m)
              : safe_subtree != query::kNowhere && hint.safe_subtree == safe_subtree;
      reported.passed_over += is_kept ? 1u : 0u;
    }
  }
}

}  // namespace

TEST(SafeSubtree_LeavesNothingOut_AlongAPath) {
  const bool is_long = std::getenv("FIRMTOUCH_LONG") != nullptr;
  Reported reported;
  for (uint32_t seed = 0; seed < (is_long ? 200u : 24u); ++seed) {
    tools::Random random(seed + 90);
    const tools::SplineCurve curve =
        spline_test::random_curve(random, static_cast<int>(2 + seed % 4), most_of(seed));
    const BakedModel baked(of(seed % 2 == 0 ? flattened(curve) : curve));
    follow(baked, random, 3000, reported);
  }
  CHECK_EQ(reported.wrong, 0u);
  CHECK_EQ(reported.inexact, 0u);
  CHECK(reported.passed_over > 100000);
}

// What the hint claims of all leaves outside the row, against points of each.
TEST(SafeSubtree_LeavesNothingNearerOutside_AfterAnyQueryOfCurves) {
  uint32_t checked = 0, wrong = 0;
  for (uint32_t seed = 0; seed < 12; ++seed) {
    tools::Random random(seed + 130);
    const tools::SplineCurve curve =
        spline_test::random_curve(random, static_cast<int>(2 + seed % 4), most_of(seed));
    const BakedModel baked(of(seed % 2 == 0 ? flattened(curve) : curve));
    const spline::View& view = baked.view;
    Path path{random, 0.002, 1.3};
    Hint hint;
    for (int turn = 0; turn < 400; ++turn) {
      const Vec3 p = path.next();
      hint.safe_subtree = query::kNowhere;
      (void)closest_point(view, p, kUnlimited, hint);
      const uint32_t first = hint.safe_subtree & 0xFFFFu, last = hint.safe_subtree >> 16;
      if (first > last || last >= view.leaf_count()) continue;
      ++checked;
      for (uint32_t leaf = 0; leaf < view.leaf_count(); ++leaf) {
        if ((leaf >= first && leaf <= last) || !view.is_leaf(leaf)) continue;
        const spline::View::LeafIndex at = view.index_of(leaf);
        const spline::Piece& piece = view.pieces()[at.piece];
        const float half = std::ldexp(1.0f, -static_cast<int>(piece.level_u));
        for (int k = -4; k <= 4; ++k) {
          const float s = half * static_cast<float>(2 * at.index_u + 1) - 1.0f +
                          half * 0.25f * static_cast<float>(k);
          const Vec3 x = spline::evaluate(piece, view.coefficients().data(), s).x;
          const double distance = std::hypot(double{piece.origin_m[0]} + double{x.x} - double{p.x},
                                             double{piece.origin_m[1]} + double{x.y} - double{p.y},
                                             double{piece.origin_m[2]} + double{x.z} - double{p.z});
          wrong += double{hint.safe_subtree_m} > distance + 4e-7 * baked.report.extent_m ? 1u : 0u;
        }
      }
    }
  }
  CHECK_EQ(wrong, 0u);
  CHECK_GE(checked, 1000u);
}

// Of all words none is a node but those that halving a whole piece comes to, in its order, and the
// tree's above.
TEST(Frontier_HoldsOnlyNodes_ThatHalvingReaches) {
  for (uint32_t seed = 0; seed < 3; ++seed) {
    tools::Random random(seed + 90);
    const BakedModel baked(of({spline_test::random_surface(random, 3, most_of(seed), 1)}));
    const spline::SurfaceNodes parts(baked.view, Vec3{});
    const uint32_t count = baked.view.pieces().size();
    uint32_t wrong = 0, deepest = 0;
    for (uint32_t piece = 0; piece <= count; ++piece) {
      std::vector<bool> is_reached(1u << 16, false);
      std::vector<uint32_t> next;
      if (piece < count) next.push_back(piece << 16 | spline::kWholePiece);
      while (!next.empty()) {
        const uint32_t node = next.back();
        next.pop_back();
        is_reached[node & 0xFFFFu] = true;
        const spline::PatchNode part = spline::apart(baked.view.pieces()[piece], node);
        deepest = std::max(deepest, part.made_u + part.made_v);
        if (part.left_u + part.left_v == 0) continue;
        const bool is_halved_u = part.left_u >= part.left_v;
        const uint32_t first = node + (is_halved_u ? part.u << 7 : part.v);
        next.push_back(first);
        next.push_back(first + (is_halved_u ? spline::kNextU : spline::kNextV));
      }
      for (uint32_t word = 0; word < 1u << 16; ++word)
        wrong += parts.is_node(piece << 16 | word) == is_reached[word] ? 0u : 1u;
    }
    for (uint32_t i = 0; i < 1u << 16; ++i)
      wrong += parts.is_node(spline::kUpper + i) == (i + 1 < count) ? 0u : 1u;
    CHECK_EQ(wrong, 0u);
    CHECK(deepest > 2);
  }
}

// Trees of one piece, of a few, and of many more than a frontier has entries.
TEST(Frontier_LeavesNothingOut_AlongAPath) {
  const bool is_long = std::getenv("FIRMTOUCH_LONG") != nullptr;
  Reported reported;
  uint32_t max_pieces = 0;
  for (uint32_t seed = 0; seed < (is_long ? 60u : 10u); ++seed) {
    tools::Random random(seed + 40);
    std::vector<tools::SplineSurface> surfaces;
    for (uint32_t i = 0; i <= seed % 3; ++i)
      surfaces.push_back(spline_test::random_surface(random, static_cast<int>(1 + random.below(3)),
                                                     static_cast<int>(1 + random.below(3)), 1));
    const BakedModel baked(of(surfaces));
    max_pieces = std::max(max_pieces, baked.view.pieces().size());
    follow(baked, random, 1000, reported);
  }
  CHECK_EQ(reported.wrong, 0u);
  CHECK_EQ(reported.inexact, 0u);
  CHECK(max_pieces > 64);
  CHECK(reported.passed_over > 10000);
}

TEST(PlanarCurve_AnswersTheSame_TurnedOutOfItsPlane) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    tools::Random random(seed + 3);
    const tools::SplineCurve curve =
        flattened(spline_test::random_curve(random, static_cast<int>(1 + seed % 5), most_of(seed)));
    const BakedModel flat(of(curve)), standing(of(lifted(curve)));
    CHECK(flat.view.is_flat());
    CHECK(!standing.view.is_flat());
    Path path{random, 0.01, 1.3};
    Hint hint, other;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = path.next();
      const spline::Closest a = closest_point(flat.view, p, kUnlimited, hint);
      const spline::Closest b = closest_point(standing.view, {p.x, -p.z, p.y}, kUnlimited, other);
      CHECK(a.certificate.exact && b.certificate.exact);
      CHECK_LE(std::fabs(double{a.distance_m} - double{b.distance_m}),
               2e-6 * (flat.report.extent_m + double{a.distance_m}));
    }
  }
}

// Twelve short curves that do not meet, of a flat model and of one in space: between two of them is
// no leaf.
TEST(Curves_AnswerAsEachAlone_WhenApart) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    tools::Random random(seed + 41);
    tools::SplineModel model;
    std::vector<BakedModel> alone;
    for (int i = 0; i < 12; ++i) {
      tools::SplineCurve curve =
          spline_test::random_curve(random, static_cast<int>(1 + seed % 4), most_of(seed));
      if (seed % 2 == 0) curve = flattened(curve);
      for (tools::ControlPoint& p : curve.points)
        p = {0.2 * p.x + 0.1 * i, 0.2 * p.y + 0.3 * (i % 3), 0.2 * p.z, p.w};
      model.curves.push_back(curve);
      alone.emplace_back(of(curve));
    }
    const BakedModel baked(model);
    const spline::View& view = baked.view;
    uint32_t none = 0;
    for (uint32_t leaf = 0; leaf < view.leaf_count(); ++leaf) none += view.is_leaf(leaf) ? 0u : 1u;
    CHECK_GE(none, 11u);
    Path path{random, 0.003, 1.3};
    Hint hint;
    for (int i = 0; i < 1500; ++i) {
      const Vec3 p = path.next();
      double truth = HUGE_VAL;
      for (const BakedModel& one : alone) {
        Hint cold;
        truth = std::min(truth, double{closest_point(one.view, p, kUnlimited, cold).distance_m});
      }
      const spline::Closest c = closest_point(view, p, kUnlimited, hint);
      CHECK(c.certificate.exact);
      CHECK_LE(std::fabs(double{c.distance_m} - truth), 2e-6 * (baked.report.extent_m + truth));
      CHECK_LE(double{c.certificate.lower_m}, truth * (1 + 1e-6));
    }
  }
}

// One piece whose ends lie beside its middle: where a query comes to be nearer to them, the middle
// is a foot-point still, the distance rises from there on both sides, and only the fourth
// derivative says that it falls again. (Beside a curve far away: else the piece would be cut for
// the sake of float32.)
TEST(Query_LeavesTheMiddle_OfAPieceThatTurnsBack) {
  for (const double weight : {1.0, 1.2, 0.8}) {
    tools::SplineCurve curve, far_away;
    curve.degree = 3;
    curve.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    curve.t1 = 1;
    // x = s - s^3, y = 0.2 s^2, for s from -1 to 1.
    curve.points = {{0, 0.2, 0, 1},
                    {-4.0 / 3, -0.2 / 3, 0, weight},
                    {4.0 / 3, -0.2 / 3, 0, weight},
                    {0, 0.2, 0, 1}};
    far_away.degree = 1;
    far_away.knots = {0, 0, 1, 1};
    far_away.t1 = 1;
    far_away.points = {{20, 20, 0, 1}, {21, 21, 0, 1}};
    tools::SplineModel model;
    model.curves = {curve, far_away};
    tools::SplineDetail detail = tools::curve_detail(false);
    detail.thickness = detail.doubt = 100;
    tools::SplineReport report;
    const auto sections = tools::bake_spline(model, "x", detail, report);
    spline::View view;
    CHECK(tools::open_baked(sections, "x", view).ok());
    CHECK_EQ(view.leaf_count(), 3u);  // two, and one between them that is none
    Hint hint;
    for (int i = 0; i <= 200; ++i) {
      const Vec3 p{1e-3f, -0.5f + 0.0075f * static_cast<float>(i), 0};
      double truth = HUGE_VAL;
      for (int k = 0; k <= 4000; ++k) {
        const tools::Point on = tools::point_at(curve, k / 4000.0);
        truth = std::min(truth, std::hypot(on.x - double{p.x}, on.y - double{p.y}));
      }
      const spline::Closest c = closest_point(view, p, kUnlimited, hint);
      CHECK(c.certificate.exact);
      CHECK_LE(double{c.distance_m}, truth + 1e-5);
      CHECK_LE(double{c.certificate.lower_m}, truth);
    }
  }
}
