// The global minimum with its certificate, against dense sampling of the file's own knots in
// double.
#include "firmtouch/spline/closest_point.hpp"

#include <cstdlib>
#include <string>

#include "bake/spline/spline_worst.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"
#include "spline/sampled_truth.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace spline_test;
using math::Vec3;
using query::Budget;
using query::kUnlimited;
using spline::Hint;

using firmtouch::test::is_long;

// Returned, exact and certified as promised, cold and warm. The result is a parameter, whose point
// in double lies on the shape: the truth is at most as far, whatever the samples missed.
void check_at(const BakedModel& baked, const SampledTruth& truth, const Vec3& p, Hint& warm) {
  const double sampled = truth.distance(tools::to_point(p));
  const double unit = baked.report.is_rational ? 1e-6 : 4e-7;
  Hint cold;
  Hint* const hints[] = {&cold, &warm};
  for (Hint* hint : hints) {
    const spline::Closest c = closest_point(baked.view, p, kUnlimited, *hint);
    const tools::Point at = baked.model.surfaces.empty()
                                ? point_at(baked.model.curves[c.piece], static_cast<double>(c.u))
                                : point_at(baked.model.surfaces[c.piece], static_cast<double>(c.u),
                                           static_cast<double>(c.v));
    const double d = std::fmin(sampled, length(at - tools::to_point(p)));
    const double slack = unit * baked.report.extent_m + 6e-7 * d;
    CHECK_EQ(c.certificate.exact, true);
    CHECK_LE(std::fabs(static_cast<double>(c.distance_m) - d), unit * baked.report.extent_m);
    CHECK_LE(static_cast<double>(c.certificate.lower_m), d * (1 + 1e-9) + 1e-12);
    CHECK_GE(static_cast<double>(c.certificate.lower_m), d - slack);
    // The returned parameter gives the returned point.
    CHECK_LE(length(at - tools::to_point(c.point_m)),
             2e-5 * baked.report.extent_m + 1.5e-7 * length(at));
  }
}

Vec3 anywhere(const BakedModel& baked, tools::Random& random) {
  const spline::Head& head = baked.view.head();
  float at[3];
  for (size_t k = 0; k < 3; ++k) {
    const auto low = static_cast<double>(head.low_m[k]), high = static_cast<double>(head.high_m[k]);
    at[k] =
        static_cast<float>(random.between(low - 0.25 * (high - low), high + 0.25 * (high - low)));
  }
  return {at[0], at[1], at[2]};
}

void check_many(const BakedModel& baked, uint32_t seed, uint32_t queries, int samples) {
  CHECK(baked.report.problem.empty());
  if (!baked.report.problem.empty()) return;
  const SampledTruth truth(baked.model, samples);
  tools::Random random(seed);
  Hint warm;
  for (uint32_t i = 0; i < queries; ++i) {
    firmtouch::test::note("seed", seed);
    check_at(baked, truth, anywhere(baked, random), warm);
    const tools::Point& on =
        truth.points()[random.below(static_cast<uint32_t>(truth.points().size()))];
    check_at(baked, truth, tools::to_vec3(on), warm);
    const double near = 0.01 * baked.report.extent_m;
    check_at(baked, truth,
             tools::to_vec3(on + tools::Point{near * random.bell(), near * random.bell(),
                                              near * random.bell()}),
             warm);
  }
}

}  // namespace

TEST(RandomCurvesOfEveryDegreeAnswerAsDenseSamplingDoes) {
  const uint32_t curves = is_long() ? 60 : 10, queries = is_long() ? 2000 : 25;
  for (uint32_t seed = 0; seed < curves; ++seed) {
    tools::Random random(seed + 1);
    const int degree = 1 + static_cast<int>(seed % 5);
    check_many(BakedModel(of(spline_test::random_curve(random, degree, degree)), seed % 2 == 1),
               seed, queries, 48);
  }
}

TEST(RandomSurfacesOfEveryDegreeAnswerAsDenseSamplingDoes) {
  const uint32_t surfaces = is_long() ? 30 : 4, queries = is_long() ? 300 : 6;
  for (uint32_t seed = 0; seed < surfaces; ++seed) {
    tools::Random random(seed + 100);
    const int u = 1 + static_cast<int>(seed % 3), v = 3 - static_cast<int>(seed % 2);
    check_many(BakedModel(of(spline_test::random_surface(random, u, v, 1)), seed % 2 == 1), seed,
               queries, 40);
  }
}

TEST(TheCentreOfACircleIsCertifiedThoughAllPointsAreAsNear) {
  const BakedModel baked(of(circle()));
  for (const float off : {0.0f, 1e-7f, 1e-5f, 1e-3f}) {
    Hint hint;
    const spline::Closest c = closest_point(baked.view, {off, 0.5f * off, 0}, kUnlimited, hint);
    CHECK_EQ(c.certificate.exact, true);
    CHECK_LE(std::fabs(static_cast<double>(c.distance_m) - 1.0) - 1.2 * static_cast<double>(off),
             2e-6);
    CHECK_GE(static_cast<double>(c.certificate.lower_m),
             1.0 - 1.2 * static_cast<double>(off) - 5e-6);
    CHECK_LE(c.certificate.steps, 4000u);  // all parts, each cut some times
  }
}

TEST(CurvesWithCoincidentControlPointsAndFoldsAnswerAsDenseSamplingDoes) {
  const tools::ControlPoint a{0, 0, 0, 1}, b{1, 0.5, 0.2, 1}, c{0.4, 1, -0.3, 1};
  check_many(BakedModel(of(bezier({a, a, a, b}))), 1, 40, 400);
  check_many(BakedModel(of(bezier({a, b, b, b, c}))), 2, 40, 400);
  check_many(BakedModel(of(bezier({a, b, c, a}))), 3, 40, 400);  // closed, a corner
  check_many(BakedModel(of(bezier({a, {1, 0, 0, 1}, {0.2, 0, 0, 1}}))), 4, 40,
             400);  // folded on itself
  check_many(BakedModel(of(bezier({a, {3, 2, 0, 1}, {-2, 2, 0, 1}, {1, 0, 0, 1}}))), 5, 40,
             400);  // a loop
}

TEST(OnTheEvoluteAndBesideItTheAnswerIsTheGlobalOne) {
  tools::Random random(3);
  const BakedModel baked(of(spline_test::random_curve(random, 3, 1)));
  const SampledTruth truth(baked.model, 200);
  const tools::SplineCurve& curve = baked.model.curves[0];
  Hint warm;
  for (int i = 1; i < 60; ++i) {
    const double t = curve.t0 + (curve.t1 - curve.t0) * i / 60.0, h = 1e-4 * (curve.t1 - curve.t0);
    const tools::Point before = point_at(curve, t - h), at = point_at(curve, t),
                       after = point_at(curve, t + h);
    const tools::Point d1 = (after - before) * (0.5 / h);
    const tools::Point d2 = (after - at * 2 + before) * (1 / (h * h));
    const tools::Point bend = d2 - d1 * (dot(d1, d2) / dot(d1, d1));
    if (!(dot(bend, bend) > 0)) continue;
    const tools::Point centre = at + bend * (dot(d1, d1) / dot(bend, bend));
    if (!(length(centre) < 5)) continue;
    check_at(baked, truth, tools::to_vec3(centre), warm);
  }
}

TEST(EveryBudgetBracketsTheTruthOnRandomModels) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    tools::Random random(seed + 50);
    const BakedModel baked(seed % 2 == 0 ? of(spline_test::random_curve(random, 3, 2))
                                         : of(spline_test::random_surface(random, 3, 3, 1)));
    const SampledTruth truth(baked.model, 40);
    Hint warm;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = anywhere(baked, random);
      const double d = truth.distance(tools::to_point(p));
      for (uint32_t work = 0; work < 4000; work += 1 + work / 16) {
        Hint cold;
        const spline::Closest c =
            closest_point(baked.view, p, Budget{work}, work % 2 == 0 ? cold : warm);
        CHECK_LE(c.certificate.work, std::max(work, 1u));
        CHECK_LE(c.certificate.steps, c.certificate.work);
        if (c.certificate.exact)
          CHECK_LE(static_cast<double>(c.distance_m), d + 1e-6 * (d + baked.report.extent_m));
        CHECK_LE(static_cast<double>(c.certificate.lower_m), d * (1 + 1e-9) + 1e-12);
        CHECK_GE(static_cast<double>(c.distance_m), d - 1e-6 * (d + baked.report.extent_m));
      }
    }
  }
}

// A path of 0.2 % of the extent a step, turning gently, that comes back to the model.
TEST(AtABudgetOfTheBakedWorstAPathIsExact) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    tools::Random random(seed + 70);
    const BakedModel baked(seed % 2 == 0 ? of(spline_test::random_curve(random, 3, 2))
                                         : of(spline_test::random_surface(random, 3, 3, 1)));
    Hint cold;
    const tools::WorstQuery worst = tools::find_worst(baked.view, {});
    const Budget budget{
        closest_point(baked.view, worst.at_m, query::kUnlimited, cold).certificate.work};
    const double step = 0.002 * baked.report.extent_m;
    const Vec3 start = anywhere(baked, random), home = anywhere(baked, random);
    tools::Point at = tools::to_point(start), way{0, 0, 0};
    Hint hint;
    uint32_t inexact = 0;
    const uint32_t moves = is_long() ? 100000 : 3000;
    for (uint32_t i = 0; i < moves; ++i) {
      way = way * 0.97 + tools::Point{random.bell(), random.bell(), random.bell()} * 0.2 +
            (tools::to_point(home) - at) * (0.02 / baked.report.extent_m);
      at = at + way * (step / length(way));
      inexact +=
          closest_point(baked.view, tools::to_vec3(at), budget, hint).certificate.exact ? 0u : 1u;
    }
    firmtouch::test::note("seed", seed);
    CHECK_LE(1000 * inexact, moves);
  }
}

TEST(AModelFarFromTheOriginIsAsGoodAsNearIt) {
  tools::Random random(8);
  tools::SplineCurve curve = spline_test::random_curve(random, 3, 1);
  for (tools::ControlPoint& p : curve.points) p.x += 512, p.y -= 256;
  check_many(BakedModel(of(curve)), 8, 30, 48);
}

TEST(TheTeapotAnswersAsDenseSamplingDoes) {
  const char* models = std::getenv("FIRMTOUCH_MODELS");
  if (models == nullptr) return firmtouch::test::skip("FIRMTOUCH_MODELS is not set");
  const BakedModel baked(tools::read_spline_file(std::string(models) + "/teapot.bpt", 0.001));
  check_many(baked, 5, is_long() ? 3000 : 10, 100);
}
