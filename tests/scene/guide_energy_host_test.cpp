// What guides give a hand while their lines and settings change, and how deep a hand is in edges.
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "curve/hard_curves.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/guide_line.hpp"
#include "firmtouch/servo/step.hpp"
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

constexpr float kReservoir_J = 0.0006f;

struct Guided {
  scene::CurveGuide guide;
  scene::CurveGuideTouch touch;
  servo::LocalModel model, next;
  servo::Settings settings{100, 1e6f, 0, 0.001f, {kReservoir_J, 0}};
  servo::State state;
  bool is_made = false;
  uint32_t due = 0;

  explicit Guided(const curve::View& curve, Vec3 free_side = {}) {
    guide.curve = &curve;
    guide.material = {static_cast<float>(kStiffness_N_per_m), 0};
    guide.snap_m = 0.02f;
    guide.release_m = 0.03f;
    guide.free_side = free_side;
  }
  Vec3 force_N(Vec3 p_m, uint32_t tick) {
    make(model, p_m, tick);
    return servo::step(state, settings, model, {p_m, {}, tick, true, false, 0}).force_N;
  }
  // At two rates: the model is of where the tool was up to `most_ticks` ago when it is taken.
  Vec3 late_force_N(Vec3 p_m, uint32_t tick, uint32_t most_ticks, Draw& draw) {
    if (is_made && tick >= due) model = next, is_made = false;
    if (!is_made) {
      make(next, p_m, tick);
      is_made = true;
      due = tick + 1 + draw.below(most_ticks);
    }
    model.expires_tick = tick + 1;
    return servo::step(state, settings, model, {p_m, {}, tick, true, false, 0}).force_N;
  }

 private:
  void make(servo::LocalModel& made, Vec3 p_m, uint32_t tick) {
    scene::begin_model(made, p_m, tick, 3);
    scene::follow_curve(guide, p_m, query::kUnlimited, touch, made);
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

// What a guide has given, less what its spring stored: the hand's work, counted in double. Taking
// hold of the tool gives what the spring then stores.
struct Account {
  double left_J = 1e9, most_J = 0;
  Vec3 last_m, last_N;
  bool was_held = false;

  void count(Vec3 at_m, Vec3 force_N, bool is_held, double stored_J, double friction_N_per_m) {
    const Vec3 move_m = at_m - last_m;
    const double given_J = product(last_N, move_m) - friction_N_per_m * product(move_m, move_m);
    left_J = is_held && !was_held ? stored_J : std::fmin(left_J - given_J, stored_J);
    most_J = std::fmax(most_J, -left_J);
    was_held = is_held, last_m = at_m, last_N = force_N;
  }
};

// A guide of any kind, whose settings change under load if `is_changed`. `late`: ticks; 0: one
// rate.
// Result: what it gave.
double given_J(uint32_t seed, bool is_changed, uint32_t late, uint32_t& pressed) {
  Draw draw(seed);
  const Points points = any_curve(draw);
  const Baked baked(points, seed % 2 != 0);
  if (!baked.report.problem.empty()) return 0;
  const Vec3 sides[] = {{}, {0, 1, 0}, {0, 0, 1}, draw.within(1)};
  Guided guided(baked.view, sides[draw.below(4)]);
  scene::CurveGuide& guide = guided.guide;
  const float penalties[] = {0, 0.02f, 0.1f, 0.5f, 2};
  guide.arc_penalty = penalties[draw.below(5)];
  if (draw.below(3) == 0) guide.tunnel_m = draw.between(0, 0.002);
  guide.ends = static_cast<scene::Ends>(draw.below(3));
  if (draw.below(2) == 0) guide.pose = {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}, draw.within(0.05)};
  const double friction = draw.below(2) == 0 ? 0 : 500;
  guided.settings.energy.friction_N_per_m = static_cast<float>(friction);
  guided.settings.ramp_in_s = draw.below(3) == 0 ? 2.0f : 0.0f;
  guided.settings.slew_limit_N_per_s = draw.below(3) == 0 ? 5000.0f : 1e6f;
  Hand hand{points, draw};
  Account account;
  for (uint32_t tick = 0; tick < 10000; ++tick) {
    hand.move();
    if (is_changed && draw.below(300) == 0)
      guide.material.stiffness_N_per_m = draw.below(5) == 0 ? 0 : draw.between(50, 2000);
    if (is_changed && draw.below(300) == 0) guide.tunnel_m = draw.between(-0.001, 0.002);
    if (is_changed && draw.below(300) == 0) guide.free_side = sides[draw.below(4)];
    const Vec3 at_m = math::apply(guide.pose, hand.at_m);
    const Vec3 force_N =
        late == 0 ? guided.force_N(at_m, tick) : guided.late_force_N(at_m, tick, late, draw);
    const servo::GuideLine& line = guided.model.guide;
    const double stretch_m = double{servo::stretch_m(line, servo::guided_off_m(line, at_m))};
    account.count(at_m, force_N, guided.model.has_guide,
                  0.5 * double{line.stiffness_N_per_m} * stretch_m * stretch_m, friction);
    pressed += product(force_N, force_N) > 0;
  }
  return guided.state.faults == 0 ? account.most_J : 1;
}

}  // namespace

// The hand goes on as the tick before, or turns by up to its step: then it may be given a tick's
// more.
TEST(Guide_AnyHandAndChange_GivesItsReservoirAtMost) {
  const uint32_t guides = test::is_long() ? 4000 : 120;
  double most_J = 0;
  uint32_t pressed = 0;
  for (const uint32_t late : {0u, 5u, 20u}) {
    for (const bool is_changed : {false, true}) {
      for (uint32_t seed = 0; seed < guides; ++seed)
        most_J = std::fmax(most_J, given_J(seed, is_changed, late, pressed));
    }
  }
  test::note("most given, nJ", static_cast<int64_t>(most_J * 1e9));
  CHECK_GE(pressed, 1000000u);
  CHECK_LE(most_J, 1.2 * double{kReservoir_J});
}

// Along a curve in a plane that holds the free side the edge is as far behind as the curve is: it
// is not set back.
TEST(Ruler_AlongAWaveAndBack_IsWhereTheCurveIs) {
  const Points points = wave(200, 0.005, 0.05);
  for (const bool is_smooth : {false, true}) {
    const Baked baked(points, is_smooth);
    Guided ruler(baked.view, {0, 1, 0});
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

// From the free side and back, past both ends too, as fast as the device's friction pays for.
TEST(Ruler_Straight_IsAsDeepAsTheHand) {
  const Points points = {point(0, 0, 0), point(0.1, 0, 0)};
  const Baked baked(points);
  Guided ruler(baked.view, {0, 1, 0});
  ruler.settings.energy = {0, 550};
  for (uint32_t tick = 0; tick < 1000; ++tick) {
    const double turn = 2 * M_PI * tick / 200;
    const Vec3 p_m = point(0.05 + 0.065 * std::cos(turn / 3), 0.002 + 0.005 * std::sin(turn), 0);
    const Vec3 force_N = ruler.force_N(p_m, tick);
    const double depth_m = std::fmax(-double{p_m.y}, 0);
    CHECK_LE(std::fabs(double{force_N.y} / kStiffness_N_per_m - depth_m), 1e-6);
    CHECK_LE(std::fabs(force_N.x), 1e-5f);
  }
}

// Where there was no edge nothing is stored: what the hand presses further it feels, and the
// reservoir.
TEST(Ruler_FreeSideGivenUnderLoad_PushesAsFarAsTheHandGoesOn) {
  const Points points = {point(0, 0, 0), point(0.1, 0, 0)};
  const Baked baked(points);
  Guided ruler(baked.view, {1, 0, 0});  // along the curve: no edge
  ruler.settings.energy.reservoir_J = 0;
  for (uint32_t tick = 0; tick < 3; ++tick) ruler.force_N(point(0.05, -0.005, 0), tick);
  ruler.guide.free_side = {0, 1, 0};
  CHECK_LE(std::fabs(ruler.force_N(point(0.05, -0.005, 0), 3).y), 1e-6f);
  CHECK_LE(std::fabs(ruler.force_N(point(0.05, -0.006, 0), 4).y - 1.0f), 1e-4f);
}
