// Splines as guides: lengths along them, which part the guide keeps to, and what open_guide() refuses.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "bake/bake_spline.hpp"
#include "bake/spline_guide.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/spline/guided_point.hpp"
#include "harness/test.hpp"
#include "spline/random_splines.hpp"

namespace {

using firmtouch::math::Vec3;
using firmtouch::query::Budget;
using firmtouch::query::Hint;
using firmtouch::query::kUnlimited;
namespace core = firmtouch::core;
namespace spline = firmtouch::spline;
namespace spline_test = firmtouch::spline_test;
namespace tools = firmtouch::tools;

struct Guide {
  tools::SplineModel model;
  std::vector<tools::Section> sections, lengths;
  tools::SplineGuideReport report;
  spline::View view;
  spline::GuideView guide;

  explicit Guide(std::vector<tools::SplineCurve> curves) {
    model.curves = std::move(curves);
    tools::SplineReport of_bake;
    sections = tools::bake_spline(model, "x", tools::curve_detail(), of_bake);
    CHECK(spline::open(tools::spline_sections(sections, "x"), view).ok());
    lengths = tools::bake_spline_guide(view, "x", report);
    CHECK_EQ(lengths.size(), 2u);
    CHECK(spline::open_guide(view, parts(), guide).ok());
  }
  spline::GuideSections parts() const { return {bytes(0), bytes(1)}; }
  core::Verdict verdict() const {
    spline::GuideView opened;
    return spline::open_guide(view, parts(), opened);
  }
  std::vector<float> arcs() const {
    std::vector<float> made(lengths[0].bytes.size() / 4);
    std::memcpy(made.data(), lengths[0].bytes.data(), lengths[0].bytes.size());
    return made;
  }
  void set_arcs(const std::vector<float>& arcs) {
    lengths[0] = tools::make_section(spline::kArcsSection, "x", arcs);
  }
  void set_chains(const std::vector<spline::Chain>& chains) {
    lengths[1] = tools::make_section(spline::kChainsSection, "x", chains);
  }

 private:
  core::Bytes bytes(size_t i) const {
    return {lengths[i].bytes.data(), static_cast<uint32_t>(lengths[i].bytes.size())};
  }
};

tools::SplineCurve through(std::vector<tools::ControlPoint> points, int degree) {
  tools::SplineCurve curve;
  curve.degree = degree;
  curve.points = std::move(points);
  const size_t inner = curve.points.size() - static_cast<size_t>(degree);
  curve.knots.assign(static_cast<size_t>(degree), 0.0);
  for (size_t i = 0; i <= inner; ++i) curve.knots.push_back(static_cast<double>(i));
  curve.knots.insert(curve.knots.end(), static_cast<size_t>(degree), static_cast<double>(inner));
  curve.t0 = 0, curve.t1 = static_cast<double>(inner);
  return curve;
}

// Two strands 4 mm apart, joined 0.2 m away, as a polygon.
tools::SplineCurve hairpin() {
  return through({{0, 0, 0, 1}, {0.2, 0, 0, 1}, {0.2, 0.004, 0, 1}, {0, 0.004, 0, 1}}, 1);
}

// A closed eight that crosses itself in the middle.
tools::SplineCurve eight() {
  return through({{0, 0, 0, 1},
                  {1, 1, 0, 1},
                  {2, 0, 0, 1},
                  {1, -1, 0, 1},
                  {0, 0, 0, 1},
                  {-1, 1, 0, 1},
                  {-2, 0, 0, 1},
                  {-1, -1, 0, 1},
                  {0, 0, 0, 1}},
                 2);
}

double length_to(const tools::SplineCurve& curve, double t) {
  double sum = 0;
  const int steps = 4000;
  for (size_t k = 0; k + 1 < curve.knots.size(); ++k) {
    const double low = std::max(curve.knots[k], curve.t0), high = std::min(curve.knots[k + 1], t);
    if (!(high > low)) continue;
    tools::Point before = point_at(curve, low);
    for (int i = 1; i <= steps; ++i) {
      const tools::Point next = point_at(curve, low + (high - low) * i / steps);
      sum += length(next - before);
      before = next;
    }
  }
  return sum;
}

double arc_at(const Guide& g, const tools::Point& on) {
  spline::Following following;
  const spline::Followed f = follow(g.guide, tools::to_vec3(on), {0, 1e3f}, kUnlimited, following);
  return static_cast<double>(f.arc) * static_cast<double>(g.guide.length_m());
}

}  // namespace

TEST(ArcPositionsAreLengthsAlongTheFilesCurve) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    tools::Random random(seed + 900);
    const tools::SplineCurve curve =
        spline_test::random_curve(random, 1 + static_cast<int>(seed % 5), 1);
    const Guide g({curve});
    const double whole = length_to(curve, curve.t1);
    firmtouch::test::note("seed", seed);
    CHECK_LE(std::fabs(static_cast<double>(g.guide.length_m()) / whole - 1), 1e-5);
    for (int i = 0; i <= 6; ++i) {
      const double t = curve.t0 + (curve.t1 - curve.t0) * i / 6;
      const tools::Point on = point_at(curve, t);
      // Where the curve passes itself another part may be told: then that is as near.
      spline::Following following;
      const spline::Followed f =
          follow(g.guide, tools::to_vec3(on), {0, 1e3f}, kUnlimited, following);
      if (std::fabs(static_cast<double>(f.closest.u) - t) > 1e-3 * (curve.t1 - curve.t0)) continue;
      const double at = length_to(curve, static_cast<double>(f.closest.u));
      CHECK_LE(std::fabs(static_cast<double>(f.arc) * whole - at), 4e-5 * whole);
    }
  }
}

TEST(ArcPositionsRiseAlongTheCurveAndEndAtItsLength) {
  const Guide g({eight()});
  double before = -1e-6;
  for (int i = 1; i < 400; ++i) {
    if (i % 50 == 0) continue;  // the crossing: either strand
    const double at = arc_at(g, point_at(g.model.curves[0], 7.0 * i / 400));
    if (std::abs(i - 200) < 8 || i < 8 || i > 392) continue;
    CHECK_LE(before, at);
    before = at;
  }
  CHECK_EQ(g.report.closed_chains, 1u);
  CHECK_EQ(g.report.chains, 1u);
}

TEST(WithoutAPenaltyTheGuideIsAtTheClosestPoint) {
  tools::Random random(5);
  const Guide g({spline_test::random_curve(random, 3, 2)});
  spline::Following following;
  Hint hint;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p =
        tools::to_vec3({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
    const spline::Followed f = follow(g.guide, p, {0, 1e3f}, kUnlimited, following);
    const spline::Closest c = closest_point(g.view, p, kUnlimited, hint);
    CHECK_LE(std::fabs(f.closest.distance_m - c.distance_m), 4e-7f * g.view.head().extent_m);
    CHECK_LE(std::hypot(f.closest.point_m.x - c.point_m.x, f.closest.point_m.y - c.point_m.y,
                        f.closest.point_m.z - c.point_m.z),
             2e-3f);
    CHECK_EQ(f.closest.certificate.steps, c.certificate.steps);
    // To its last digits: across the curve.
    const Vec3 off{p.x - f.closest.point_m.x, p.y - f.closest.point_m.y, p.z - f.closest.point_m.z};
    const float along = off.x * f.closest.direction.x + off.y * f.closest.direction.y +
                        off.z * f.closest.direction.z;
    const bool is_inside = f.closest.s > -1 && f.closest.s < 1;
    if (is_inside) CHECK_LE(std::fabs(along), 2e-5f * f.closest.distance_m + 1e-6f);
    CHECK(f.is_held);
  }
}

TEST(APenaltyKeepsTheGuideOnItsStrandAndNoneDoesNot) {
  const Guide g({hairpin()});
  for (const float weight : {0.0f, 0.1f}) {
    spline::Following following;
    const spline::Hold hold{weight * g.guide.length_m(), 0.03f};
    (void)follow(g.guide, {0.05f, 0.001f, 0}, hold, kUnlimited, following);
    const spline::Followed f = follow(g.guide, {0.052f, 0.003f, 0}, hold, kUnlimited, following);
    CHECK_EQ(f.closest.point_m.y > 0.002f, !(weight > 0));
    CHECK(!f.is_new);
    // Its bound is that of the whole curve all the same.
    CHECK_LE(f.closest.certificate.lower_m, 0.0010001f);
    CHECK_GE(f.closest.certificate.lower_m, 0.00099f);
    CHECK(f.closest.certificate.exact);
    const spline::Followed far = follow(g.guide, {0.052f, 0.035f, 0}, hold, kUnlimited, following);
    CHECK(!far.is_held || far.closest.distance_m <= 0.03f);
  }
}

TEST(AroundAnEightTheGuideRunsThroughTheCrossingBothTimes) {
  const Guide g({eight()});
  const tools::SplineCurve& curve = g.model.curves[0];
  for (const float weight : {0.1f, 1.0f}) {
    spline::Following following;
    double way = 0, worst = 0;
    for (int i = 0; i <= 2 * 3000; ++i) {
      const double t = 7.0 * ((i + 350) % 3000) / 3000;
      tools::Point at = point_at(curve, t);
      at.z += 0.01;
      const spline::Followed f = follow(g.guide, tools::to_vec3(at),
                                        {weight * g.guide.length_m(), 0.5f}, kUnlimited, following);
      way += static_cast<double>(f.change_of_arc);
      worst = std::max(worst, std::fabs(static_cast<double>(f.change_of_arc)));
    }
    CHECK_LE(std::fabs(way - 2), 2e-3);
    CHECK_LE(worst, 0.002);
  }
}

TEST(NoStateMakesTheGuidesAnswerWorseThanTheClosestPoints) {
  tools::Random random(77);
  const Guide g({spline_test::random_curve(random, 3, 1), spline_test::random_curve(random, 2, 1)});
  for (int i = 0; i < 2000; ++i) {
    spline::Following following;
    following.piece = random.below(i % 3 == 0 ? 0xFFFFFFFFu : 40);
    following.s = firmtouch::math::float_of(random.below(0xFFFFFFFFu));
    following.arc = i % 5 == 0 ? firmtouch::math::float_of(random.below(0xFFFFFFFFu))
                               : static_cast<float>(random.between(0, 1));
    following.is_following = true;
    following.hint.place = random.below(0xFFFFFFFFu);
    const Vec3 p =
        tools::to_vec3({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
    const uint32_t steps = i % 2 == 0 ? UINT32_MAX : 2 + random.below(60);
    const float was = following.arc;
    const bool is_sound = was >= 0 && was <= 1 && following.piece < g.view.pieces().size();
    const spline::Hold hold{0.1f * g.guide.length_m(), 1e3f};
    const spline::Followed f = follow(g.guide, p, hold, Budget{steps}, following);
    Hint cold;
    const spline::Closest c = closest_point(g.view, p, kUnlimited, cold);
    CHECK_LE(f.closest.certificate.steps, steps);
    CHECK_LE(f.closest.certificate.lower_m, c.distance_m);
    CHECK_GE(f.closest.distance_m, c.certificate.lower_m);
    CHECK(f.arc >= 0 && f.arc <= 1.00001f);
    // Never by more than the penalty that the closest point would cost: half a round at most.
    if (steps == UINT32_MAX && is_sound)
      CHECK_LE(f.closest.distance_m, c.distance_m + hold.weight_m * 1.001f);
    CHECK(following.arc - following.arc <= 0.0f && following.s >= -1 && following.s <= 1);
  }
}

TEST(HostileQueriesOfAGuideLetGoAndGiveFiniteNumbers) {
  const Guide g({eight()});
  const float bad[] = {NAN, HUGE_VALF, -HUGE_VALF, 3e38f, 1e-45f};
  for (const float value : bad) {
    spline::Following following;
    (void)follow(g.guide, {0.1f, 0.1f, 0}, {0.5f, 0.5f}, kUnlimited, following);
    CHECK(following.is_following);
    const spline::Followed f =
        follow(g.guide, {value, 0, value}, {0.5f, 0.5f}, kUnlimited, following);
    CHECK(f.closest.distance_m - f.closest.distance_m <= 0.0f);
    CHECK(f.arc - f.arc <= 0.0f);
    CHECK_EQ(f.is_held, value < 1e-40f && value > 0);
    const spline::Followed back =
        follow(g.guide, {0.1f, 0.1f, 0}, {value, 0.5f}, kUnlimited, following);
    CHECK(back.is_held);
  }
}

TEST(SeveralCurvesAreChainsWithTheirOwnEnds) {
  const Guide g({through({{0, 0, 0, 1}, {1, 0, 0, 1}}, 1), through({{1, 0, 0, 1}, {1, 1, 0, 1}}, 1),
                 through({{3, 0, 0, 1}, {4, 0, 0, 1}}, 1)});
  CHECK_EQ(g.report.chains, 2u);
  CHECK_LE(std::fabs(g.report.length_m - 3), 1e-6);
  struct {
    Vec3 p;
    int end;
    float behind, ahead;
  } cases[] = {{{-0.1f, 0, 0}, -1, 0, 2},       {{0.5f, 0.1f, 0}, 0, 0.5f, 1.5f},
               {{1.1f, -0.1f, 0}, 0, 1, 1},     {{1, 1.1f, 0}, 1, 2, 0},
               {{2.9f, 0, 0}, -1, 0, 1},        {{4.1f, 0, 0}, 1, 1, 0},
               {{3.25f, 0, 0}, 0, 0.25f, 0.75f}};
  for (const auto& c : cases) {
    spline::Following following;
    const spline::Followed f = follow(g.guide, c.p, {0, 9}, kUnlimited, following);
    CHECK_EQ(f.end, c.end);
    CHECK_LE(std::fabs(f.behind_m - c.behind), 1e-5f);
    CHECK_LE(std::fabs(f.ahead_m - c.ahead), 1e-5f);
  }
}

TEST(Rule641RefusesArcsThatAreNotOfThePieces) {
  Guide g({eight()});
  std::vector<float> arcs = g.arcs();
  arcs.push_back(arcs.back());
  g.set_arcs(arcs);
  CHECK_EQ(g.verdict().rule, 641);
  g.set_arcs({});
  CHECK_EQ(g.verdict().rule, 641);
}

TEST(Rule642RefusesChainsThatAreNotOfThePieces) {
  Guide g({eight()});
  const std::vector<std::vector<spline::Chain>> bad = {
      {}, {{1, 0}}, {{0, 2}}, {{0, 0}, {0, 0}}, {{0, 0}, {60000, 0}}};
  for (const auto& chains : bad) {
    g.set_chains(chains);
    CHECK_EQ(g.verdict().rule, 642);
  }
}

TEST(Rule643RefusesArcsThatDoNotRise) {
  Guide g({eight()});
  const std::vector<float> sound = g.arcs();
  for (const float bad : {NAN, -1.0f, HUGE_VALF}) {
    std::vector<float> arcs = sound;
    arcs[2] = bad;
    g.set_arcs(arcs);
    CHECK_EQ(g.verdict().rule, 643);
  }
  std::vector<float> arcs = sound;
  arcs[0] = 0.001f;
  g.set_arcs(arcs);
  CHECK_EQ(g.verdict().rule, 643);
}

TEST(Rule644RefusesArcsThatAreNotTheCurvesLengths) {
  Guide g({eight()});
  std::vector<float> arcs = g.arcs();
  for (size_t i = 2; i < arcs.size(); ++i) arcs[i] += 0.2f * (arcs[2] - arcs[1]);
  g.set_arcs(arcs);
  const core::Verdict verdict = g.verdict();
  CHECK_EQ(verdict.rule, 644);
  CHECK_EQ(verdict.element, 1u);
}

TEST(Rule645RefusesChainsWithAGap) {
  Guide g({through({{0, 0, 0, 1}, {1, 0, 0, 1}}, 1), through({{2, 0, 0, 1}, {3, 0, 0, 1}}, 1)});
  g.set_chains({{0, 0}});
  CHECK_EQ(g.verdict().rule, 645);
  g.set_chains({{0, 0}, {1, 1}});
  CHECK_EQ(g.verdict().rule, 645);
}
