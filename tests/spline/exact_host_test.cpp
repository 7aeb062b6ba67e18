// Every answer against intervals that certainly hold the truth: the returned point, the lower bound
// and `exact`, at the places where a search may go wrong.
#include <cmath>
#include <vector>

#include "firmtouch/spline/closest_point.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/exact_distance.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace spline_test;
using math::Vec3;
using query::Budget;
using spline::Hint;
using tools_point = firmtouch::tools::Point;  // in double

using firmtouch::test::is_long;
// No query here needs as many; one that went on for ever would say so.
constexpr Budget kPlenty{300000};

struct Baked : spline_test::BakedModel {
  ExactDistance exact;
  Hint warm;

  explicit Baked(const tools::SplineModel& from) : BakedModel(from), exact(model) {
    CHECK(report.problem.empty());
  }
};

struct Truth {
  double lo, hi;
};
Truth truth_of(const ExactDistance& exact, const tools_point& p) {
  const spline_test::Interval d = exact.distance(p);
  // A double as low, and one as high.
  return {std::nextafter(static_cast<double>(d.lo), -HUGE_VAL) < 0
              ? 0
              : std::nextafter(static_cast<double>(d.lo), -HUGE_VAL),
          std::nextafter(static_cast<double>(d.hi), HUGE_VAL)};
}

// What an answer claims, whatever its budget.
void check_answer(const Baked& baked, const Truth& truth, const spline::Closest& c) {
  const double unit = (baked.report.is_rational ? 1e-6 : 4e-7) * baked.report.extent_m;
  const double rounding = 9e-7 * truth.hi;
  const double reported = double{c.distance_m}, lower = double{c.certificate.lower_m};
  CHECK_LE(lower, truth.lo);
  CHECK_GE(reported, truth.lo - unit - rounding);
  if (!c.certificate.exact) return;
  CHECK_LE(reported, truth.hi + unit + rounding);
  CHECK_GE(lower, truth.lo - unit - rounding);
}

// Cold, warm, and within budgets.
void check_at(Baked& baked, const Vec3& p) {
  const Truth truth = truth_of(baked.exact, tools::to_point(p));
  CHECK_LE(truth.hi - truth.lo, 1e-7 * baked.report.extent_m + 1e-12 * truth.hi);
  Hint cold;
  const spline::Closest alone = closest_point(baked.view, p, kPlenty, cold);
  CHECK(alone.certificate.exact);
  check_answer(baked, truth, alone);
  const spline::Closest after = closest_point(baked.view, p, kPlenty, baked.warm);
  CHECK(after.certificate.exact);
  check_answer(baked, truth, after);
  for (const uint32_t steps : {1u, 5u, 17u, 60u, 200u}) {
    Hint fresh;
    const spline::Closest cut = closest_point(baked.view, p, Budget{steps}, fresh);
    CHECK_LE(cut.certificate.steps, steps);
    check_answer(baked, truth, cut);
    check_answer(baked, truth, closest_point(baked.view, p, Budget{steps}, fresh));
  }
}

void check_at(Baked& baked, const tools_point& p) { check_at(baked, tools::to_vec3(p)); }

// The place itself and its neighbours in float32.
void check_about(Baked& baked, const tools_point& p) {
  const Vec3 at = tools::to_vec3(p);
  check_at(baked, at);
  for (int axis = 0; axis < 3; ++axis)
    for (const float to : {-HUGE_VALF, HUGE_VALF}) {
      Vec3 beside = at;
      float& x = axis == 0 ? beside.x : axis == 1 ? beside.y : beside.z;
      x = std::nextafterf(x, to);
      check_at(baked, beside);
    }
}

// A vase: a cubic profile turned about z.
tools::SplineSurface vase() {
  const double profile[4][2] = {{0.5, 0}, {1.1, 0.4}, {0.2, 0.9}, {0.6, 1.4}};  // radius, height
  tools::SplineSurface s;
  s.degree_u = 2, s.degree_v = 3;
  s.count_u = 9, s.count_v = 4;
  s.knots_u = circle().knots;
  s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
  s.u1 = 4;
  for (const auto& at : profile)
    for (const tools::ControlPoint& c : circle().points)
      s.points.push_back({c.x * at[0], c.y * at[0], at[1], c.w});
  return s;
}

tools_point derivative(const tools::SplineCurve& c, double t, double h) {
  return (point_at(c, t + h) - point_at(c, t - h)) * (0.5 / h);
}

}  // namespace

TEST(TheIntervalsHoldDistancesThatAreKnown) {
  const ExactDistance exact(of(circle()));
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.7 * i, away = 0.05 * i, up = 0.3 * std::sin(1.0 * i);
    const tools_point p{away * std::cos(angle), away * std::sin(angle), up};
    const Truth d = truth_of(exact, p);
    const double truth = std::hypot(std::hypot(p.x, p.y) - 1, up);
    CHECK_LE(d.lo, truth + 1e-12);
    CHECK_GE(d.hi, truth - 1e-12);
    CHECK_LE(d.hi - d.lo, 1e-7);
  }
  const Truth centre = truth_of(exact, {0, 0, 0});
  CHECK_LE(centre.lo, 1.0);
  CHECK_GE(centre.hi, 1.0);
  CHECK_LE(centre.hi - centre.lo, 1e-8);
}

TEST(AtAndBesideTheCentreOfACircleNothingIsWrong) {
  Baked baked(of(circle()));
  check_about(baked, {0, 0, 0});
  for (const double off : {1e-20, 1e-12, 1e-9, 1e-7, 3e-7, 1e-6, 1e-5, 1e-4, 1e-3})
    check_about(baked, {off, 0.7 * off, -0.3 * off});
  for (int i = 1; i < 20; ++i) check_at(baked, tools_point{0, 0, 0.2 * i});  // on its axis
}

TEST(OnTheAxisOfASurfaceOfRevolutionNothingIsWrong) {
  Baked baked(of(vase()));
  for (int i = 0; i < (is_long() ? 200 : 8); ++i) {
    const double z = -0.2 + 1.8 * i / (is_long() ? 200 : 8);
    check_at(baked, tools_point{0, 0, z});
    check_at(baked, tools_point{1e-6, 0, z});
    check_at(baked, tools_point{0, -1e-4, z});
  }
}

TEST(OnTheEvoluteNothingIsWrong) {
  for (uint32_t seed = 0; seed < (is_long() ? 20u : 3u); ++seed) {
    tools::Random random(seed + 31);
    Baked baked(of(spline_test::random_curve(random, 3, 1)));
    const tools::SplineCurve& c = baked.model.curves[0];
    for (int i = 1; i < 24; ++i) {
      const double span = c.t1 - c.t0, t = c.t0 + span * i / 24.1, h = 1e-4 * span;
      const tools_point at = point_at(c, t), d1 = derivative(c, t, h);
      const tools_point d2 = (point_at(c, t + h) - at * 2 + point_at(c, t - h)) * (1 / (h * h));
      const tools_point bend = d2 - d1 * (dot(d1, d2) / dot(d1, d1));
      if (!(dot(bend, bend) > 0)) continue;
      const tools_point centre = at + bend * (dot(d1, d1) / dot(bend, bend));
      if (length(centre) < 20) check_about(baked, centre);
    }
  }
}

TEST(AtFocalPointsOfASurfaceNothingIsWrong) {
  // Both centres of curvature of a torus-like tube: of its section, and on the axis.
  tools::Random random(4);
  Baked baked(of(spline_test::random_surface(random, 3, 3, 1)));
  const tools::SplineSurface& s = baked.model.surfaces[0];
  const double hu = 1e-4 * (s.u1 - s.u0), hv = 1e-4 * (s.v1 - s.v0);
  for (int i = 0; i < (is_long() ? 300 : 10); ++i) {
    const double u = random.between(s.u0 + 2 * hu, s.u1 - 2 * hu);
    const double v = random.between(s.v0 + 2 * hv, s.v1 - 2 * hv);
    const auto at = [&](double du, double dv) { return point_at(s, u + du * hu, v + dv * hv); };
    const tools_point x = at(0, 0), xu = (at(1, 0) - at(-1, 0)) * (0.5 / hu),
                      xv = (at(0, 1) - at(0, -1)) * (0.5 / hv);
    const tools_point uu = (at(1, 0) - x * 2 + at(-1, 0)) * (1 / (hu * hu));
    const tools_point vv = (at(0, 1) - x * 2 + at(0, -1)) * (1 / (hv * hv));
    const tools_point uv = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) * (0.25 / (hu * hv));
    const tools_point normal = cross(xu, xv) * (1 / length(cross(xu, xv)));
    const double e = dot(xu, xu), f = dot(xu, xv), g = dot(xv, xv);
    const double l = dot(uu, normal), m = dot(uv, normal), n = dot(vv, normal);
    // Of (l - k e)(n - k g) = (m - k f)^2.
    const double a = e * g - f * f, b = 2 * f * m - e * n - g * l, c = l * n - m * m;
    const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
    for (const double k : {(-b + root) / (2 * a), (-b - root) / (2 * a)})
      if (std::fabs(k) > 0.1) check_at(baked, x + normal * (1 / k));
  }
}

TEST(OnTheMedialAxisNothingIsWrong) {
  // Two foot-points as near as one another, to the last digits: by bisection between random places.
  for (uint32_t seed = 0; seed < (is_long() ? 30u : 3u); ++seed) {
    tools::Random random(seed + 700);
    Baked baked(seed % 3 == 2 ? of(spline_test::random_surface(random, 3, 2, 1))
                              : of(spline_test::random_curve(random, 3, 1)));
    const auto place = [&](const tools_point& p) {
      Hint hint;
      const spline::Closest c = closest_point(baked.view, tools::to_vec3(p), kPlenty, hint);
      return tools::to_point(c.point_m);
    };
    for (int i = 0; i < 12; ++i) {
      const auto any = [&] {
        return tools_point{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      };
      tools_point a = any(), b = any();
      for (int k = 0; k < 40; ++k) {
        const tools_point middle = (a + b) * 0.5, at = place(middle);
        (length(at - place(a)) < length(at - place(b)) ? a : b) = middle;
      }
      check_about(baked, a);
      check_at(baked, b);
    }
  }
}

TEST(AtSelfCrossingsAndOnTheShapeNothingIsWrong) {
  Baked loop(of(bezier({{0, 0, 0, 1}, {3, 2, 0, 1}, {-2, 2, 0, 1}, {1, 0, 0, 1}})));
  check_about(loop, {0.5, 0.833333333333, 0});  // about its crossing
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    check_about(loop, point_at(loop.model.curves[0], t));
    check_at(loop, point_at(loop.model.curves[0], t) + tools_point{1e-7, -1e-7, 1e-7});
  }
  Baked round(of(vase()));
  for (int i = 0; i <= (is_long() ? 200 : 12); ++i)
    check_at(round, point_at(round.model.surfaces[0], 0.3 * (i % 13), 0.07 * (i % 14)));
}

TEST(AtKnotsWithCornersAndJumpsOfCurvatureNothingIsWrong) {
  for (const int most : {2, 3}) {  // C1 and C0 of cubics
    tools::Random random(static_cast<uint32_t>(40 + most));
    Baked baked(of(spline_test::random_curve(random, 3, most)));
    const tools::SplineCurve& c = baked.model.curves[0];
    for (const double knot : c.knots) {
      if (!(knot >= c.t0 && knot <= c.t1)) continue;
      const tools_point at = point_at(c, knot);
      check_about(baked, at);
      for (int i = 0; i < 6; ++i) {
        const tools_point off{random.bell(), random.bell(), random.bell()};
        check_at(baked, at + off * std::pow(10.0, -i));
        // On the normals of both sides, where a foot-point passes the knot.
        const double h = 1e-5 * (c.t1 - c.t0);
        for (const double side : {-h, h}) {
          const tools_point d = derivative(c, knot + 2 * side, h);
          if (dot(d, d) > 0) check_at(baked, at + off - d * (dot(off, d) / dot(d, d)));
        }
      }
    }
  }
}

TEST(WhereThreeOrFourControlPointsCoincideNothingIsWrong) {
  const tools::ControlPoint a{0, 0, 0, 1}, b{1, 0.5, 0.2, 1}, c{0.4, 1, -0.3, 1},
      d{-1, 0.3, 0.5, 1};
  const std::vector<std::vector<tools::ControlPoint>> shapes = {
      {a, a, a, b}, {a, b, b, b, c}, {d, a, a, a, c, b}, {b, a, a, a, a, c}, {a, a, b, b}};
  for (size_t i = 0; i < shapes.size(); ++i) {
    Baked baked(of(bezier(shapes[i])));
    tools::Random random(static_cast<uint32_t>(i + 1));
    check_about(baked, {0, 0, 0});
    check_about(baked, {1, 0.5, 0.2});
    for (int k = 0; k < (is_long() ? 2000 : 20); ++k) {
      check_at(baked, tools_point{random.between(-1.5, 1.5), random.between(-1.5, 1.5),
                                  random.between(-1.5, 1.5)});
      check_at(baked, point_at(baked.model.curves[0], random.between(0, 1)) +
                          tools_point{random.bell(), random.bell(), random.bell()} *
                              std::pow(10.0, random.between(-7, -1)));
    }
  }
  tools::SplineSurface pole = vase();  // a row of control points that is one point
  for (size_t i = 0; i < 9; ++i) pole.points[i].x = pole.points[i].y = 0;
  Baked baked(of(pole));
  check_about(baked, {0, 0, 0});
  check_at(baked, tools_point{0, 0, -0.5});
  check_at(baked, tools_point{1e-4, 0, 0.01});
  check_at(baked, tools_point{0.01, -0.02, -0.01});
}

TEST(AnUlpAboutEveryFaceOfALeafNothingIsWrong) {
  // A leaf ends where its piece's parameter is halved: there two leaves meet, and beside it ulps.
  tools::Random random(12);
  Baked curve(of(spline_test::random_curve(random, 3, 1)));
  Baked surface(of(spline_test::random_surface(random, 3, 3, 1)));
  for (Baked* baked : {&curve, &surface}) {
    const bool is_surface = baked->view.is_surface();
    const uint32_t pieces = baked->view.pieces().size();
    for (uint32_t k = 0; k < pieces; k += is_surface && !is_long() ? 1 + pieces / 4 : 1) {
      const spline::Piece& piece = baked->view.pieces()[k];
      for (int i = 0; i <= (is_surface ? 2 : 8); ++i) {
        const double u =
            double{piece.middle_u} + double{piece.half_u} * (i * (is_surface ? 1 : 0.25) - 1);
        const double v = double{piece.middle_v} + double{piece.half_v} * 0.5;
        const tools_point at = is_surface ? point_at(baked->model.surfaces[0], u, v)
                                          : point_at(baked->model.curves[0], u);
        check_about(*baked, at);
        const tools_point off{random.bell(), random.bell(), random.bell()};
        check_at(*baked, at + off * 0.05);
      }
    }
    // And about the corners of the box of all.
    const spline::Head& head = baked->view.head();
    for (int corner = 0; corner < 8; ++corner)
      check_about(*baked, {double{(corner & 1) != 0 ? head.high_m[0] : head.low_m[0]},
                           double{(corner & 2) != 0 ? head.high_m[1] : head.low_m[1]},
                           double{(corner & 4) != 0 ? head.high_m[2] : head.low_m[2]}});
  }
}

TEST(FarAwayNothingIsWrong) {
  tools::Random random(21);
  Baked curve(of(spline_test::random_curve(random, 4, 1)));
  Baked surface(of(spline_test::random_surface(random, 2, 3, 1)));
  for (Baked* baked : {&curve, &surface})
    for (int i = 0; i < 9; ++i) {
      const tools_point way{random.bell(), random.bell(), random.bell()};
      check_at(*baked, way * std::pow(10.0, i));
    }
}

TEST(RandomJumpsAndPathsOfRandomModelsAreNeverWrong) {
  const uint32_t models = is_long() ? 30 : 6, queries = is_long() ? 400 : 12;
  for (uint32_t seed = 0; seed < models; ++seed) {
    tools::Random random(seed + 5000);
    Baked baked(seed % 3 == 2
                    ? of(spline_test::random_surface(random, 3, 3, 1))
                    : of(spline_test::random_curve(random, 1 + static_cast<int>(seed % 5), 2)));
    firmtouch::test::note("seed", seed);
    tools_point at{0, 0, 0};
    for (uint32_t i = 0; i < queries; ++i) {
      at = at + tools_point{random.bell(), random.bell(), random.bell()} * 0.004;
      check_at(baked, at);
      check_at(baked, tools_point{random.between(-1.5, 1.5), random.between(-1.5, 1.5),
                                  random.between(-1.5, 1.5)});
    }
  }
}
