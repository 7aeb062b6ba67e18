// One-sided guides: what their edges give a hand, and how deep a hand is in them.
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "curve/hard_curves.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "scene/draw.hpp"

using namespace firmtouch;  // NOLINT: a test file
using curve_test::Baked;
using curve_test::point;
using curve_test::Points;
using math::Vec3;
using scene_test::Draw;

namespace {

constexpr double kStiffness_N_per_m = 1000;

double product(Vec3 a, Vec3 b) {
  return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
}

Points wave(int count, double height_m, double length_m) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(point(0.001 * i, height_m * std::sin(2 * M_PI * 0.001 * i / length_m), 0));
  return points;
}

// Knots, coils, an eight, stairs, waves.
Points any_curve(Draw& draw) {
  const uint32_t kind = draw.below(5);
  const int count = 4 + static_cast<int>(draw.below(120));
  if (kind == 4)
    return wave(count, double{draw.between(0.001, 0.01)}, double{draw.between(0.01, 0.05)});
  Points points;
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * M_PI * i / count;
    if (kind == 0)
      points.push_back(draw.within(0.05));
    else if (kind == 1)
      points.push_back(point(0.03 * std::cos(4 * turn), 0.03 * std::sin(4 * turn), 0.003 * turn));
    else if (kind == 2)
      points.push_back(
          point(0.05 * std::cos(turn), 0.05 * std::sin(2 * turn), 0.002 * std::sin(turn)));
    else
      points.push_back(point(0.002 * i, 0.004 * (i / 3 % 2) + double{draw.between(0, 2e-4)},
                             0.004 * (i / 5 % 2)));
  }
  return points;
}

struct Ruler {
  scene::CurveGuide guide;
  scene::CurveGuideTouch touch;
  servo::LocalModel model;

  explicit Ruler(const curve::View& curve, Vec3 free_side) {
    guide.curve = &curve;
    guide.material = {static_cast<float>(kStiffness_N_per_m), 0};
    guide.snap_m = 0.02f;
    guide.release_m = 0.03f;
    guide.free_side = free_side;
  }
  Vec3 force_N(Vec3 p_m, uint32_t tick) {
    scene::begin_model(model, p_m, tick, 3);
    scene::follow_curve(guide, p_m, query::kUnlimited, touch, model);
    return servo::evaluate(model, p_m, {});
  }
};

// A hand that goes from place to place about the curve in steps of one length.
struct Hand {
  const Points& curve;
  Draw& draw;
  double step_m = std::pow(10, double{draw.between(-5, -3.7)});
  Vec3 at_m = any_sample();
  Vec3 to_m = at_m;

  Vec3 any_sample() { return curve[draw.below(static_cast<uint32_t>(curve.size()))]; }
  void move() {
    const Vec3 way = to_m - at_m;
    const double size_m = std::sqrt(product(way, way));
    if (size_m > step_m) {
      at_m = at_m + way * static_cast<float>(step_m / size_m);
      return;
    }
    at_m = to_m;
    const Vec3 about_m = draw.below(2) == 0 ? at_m : any_sample();
    to_m = about_m + draw.within(draw.below(4) == 0 ? 0.03 : 0.012);
  }
};

}  // namespace

// What the spring stores never rises by more than the hand puts in, except for the snap.
TEST(Ruler_AnyCurveAndHand_GivesNoEnergy) {
  const uint32_t rulers = test::is_long() ? 4000 : 120;
  double most_J = 0;
  uint32_t pressed = 0;
  for (uint32_t seed = 0; seed < rulers; ++seed) {
    Draw draw(seed);
    const Points points = any_curve(draw);
    const Baked baked(points, seed % 2 != 0);
    if (!baked.report.problem.empty()) continue;
    const Vec3 sides[] = {{0, 1, 0}, {0, 0, 1}, draw.within(1)};
    Ruler ruler(baked.view, sides[draw.below(3)]);
    const float penalties[] = {0, 0.02f, 0.1f, 0.5f, 2};
    ruler.guide.arc_penalty = penalties[draw.below(5)];
    if (draw.below(3) == 0) ruler.guide.tunnel_m = draw.between(0, 0.002);
    ruler.guide.ends = static_cast<scene::Ends>(draw.below(3));
    if (draw.below(2) == 0)
      ruler.guide.pose = {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}, draw.within(0.05)};
    Hand hand{points, draw};
    Vec3 last_m, last_N;
    bool was_held = false;
    double stored_J = 0, given_J = 0;
    for (uint32_t tick = 0; tick < 10000; ++tick) {
      hand.move();
      const Vec3 at_m = math::apply(ruler.guide.pose, hand.at_m);
      const Vec3 force_N = ruler.force_N(at_m, tick);
      const double now_J = product(force_N, force_N) / (2 * kStiffness_N_per_m);
      if (was_held && ruler.touch.is_held)
        given_J += 0.5 * product(force_N + last_N, at_m - last_m) + now_J - stored_J;
      else
        given_J = 0;
      given_J = std::fmax(given_J, 0);  // what was lost before is not given back
      most_J = std::fmax(most_J, given_J);
      pressed += now_J > 0;
      was_held = ruler.touch.is_held;
      stored_J = now_J, last_N = force_N, last_m = at_m;
    }
  }
  test::note("most given, nJ", static_cast<int64_t>(most_J * 1e9));
  CHECK_GE(pressed, 100000u);
  CHECK_LE(most_J, 5e-5);
}

// Along a curve in a plane that holds the free side the edge is as far behind as the curve is: it
// is not set back.
TEST(Ruler_AlongAWaveAndBack_IsWhereTheCurveIs) {
  const Points points = wave(200, 0.005, 0.05);
  for (const bool is_smooth : {false, true}) {
    const Baked baked(points, is_smooth);
    Ruler ruler(baked.view, {0, 1, 0});
    for (uint32_t tick = 0; tick < 12000; ++tick) {
      const uint32_t at = tick % 3000 < 1500 ? tick % 3000 : 2999 - tick % 3000;
      const double x_m = 0.02 + 1e-4 * at;
      const Vec3 p_m = point(x_m, 0.005 * std::sin(2 * M_PI * x_m / 0.05) - 0.002, 0);
      const Vec3 force_N = ruler.force_N(p_m, tick);
      const double depth_m = std::sqrt(product(force_N, force_N)) / kStiffness_N_per_m;
      CHECK_GE(depth_m, 0.99 * curve_test::brute_distance(points, p_m));
    }
  }
}

// In steps of any length, from the free side and back.
TEST(Ruler_Straight_IsAsDeepAsTheHand) {
  const Points points = {point(0, 0, 0), point(0.1, 0, 0)};
  const Baked baked(points);
  Ruler ruler(baked.view, {0, 1, 0});
  Draw draw(1);
  for (uint32_t tick = 0; tick < 1000; ++tick) {
    const Vec3 p_m{draw.between(0.02, 0.08), draw.between(-0.01, 0.005), 0};
    const Vec3 force_N = ruler.force_N(p_m, tick);
    const double depth_m = std::fmax(-double{p_m.y}, 0);
    CHECK_LE(std::fabs(double{force_N.y} / kStiffness_N_per_m - depth_m), 1e-6);
  }
}

// Where there was no edge nothing is stored.
TEST(Ruler_FreeSideGivenUnderLoad_PushesAsFarAsTheHandGoesOn) {
  const Points points = {point(0, 0, 0), point(0.1, 0, 0)};
  const Baked baked(points);
  for (const Vec3 before : {Vec3{}, Vec3{1, 0, 0}}) {
    Ruler ruler(baked.view, before);
    for (uint32_t tick = 0; tick < 3; ++tick) ruler.force_N(point(0.05, -0.005, 0), tick);
    ruler.guide.free_side = {0, 1, 0};
    CHECK_LE(std::fabs(ruler.force_N(point(0.05, -0.005, 0), 3).y), 1e-6f);
    CHECK_LE(std::fabs(ruler.force_N(point(0.05, -0.006, 0), 4).y - 1.0f), 1e-4f);
  }
}
