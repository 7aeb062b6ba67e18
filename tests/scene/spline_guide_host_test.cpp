// A spline curve as a guide: whatever a sampled curve does in the scene it does as well.
#include <cmath>
#include <vector>

#include "bake/curve/bake_curve.hpp"
#include "bake/spline/bake_spline.hpp"
#include "bake/spline/spline_guide.hpp"
#include "curve/small_curve.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/scene/spline_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using curve_test::SmallCurve;

// The corners as a spline of degree 1.
struct Splines {
  std::vector<tools::Section> sections, lengths;
  spline::View view;
  spline::GuideView guide;
  template <size_t N>
  explicit Splines(const curve::Sample (&corners)[N]) {
    tools::SplineCurve line;
    line.degree = 1;
    line.knots = {0};
    for (size_t i = 0; i < N; ++i) {
      line.points.push_back({static_cast<double>(corners[i].x_m),
                             static_cast<double>(corners[i].y_m),
                             static_cast<double>(corners[i].z_m), 1});
      line.knots.push_back(static_cast<double>(i));
    }
    line.knots.push_back(static_cast<double>(N - 1));
    line.t1 = static_cast<double>(N - 1);
    open(line);
  }
  explicit Splines(const tools::SplineCurve& line) { open(line); }

 private:
  void open(const tools::SplineCurve& line) {
    tools::SplineModel model;
    model.curves.push_back(line);
    tools::SplineReport report;
    sections = tools::bake_spline(model, "x", tools::curve_detail(false), report);
    CHECK(tools::open_baked(sections, "x", view).ok());
    tools::SplineGuideReport of_guide;
    lengths = tools::bake_spline_guide(view, "x", of_guide);
    const auto bytes = [&](size_t i) {
      return firmtouch::core::Bytes{lengths[i].bytes.data(),
                                    static_cast<uint32_t>(lengths[i].bytes.size())};
    };
    CHECK(spline::open_guide(view, {bytes(0), bytes(1)}, guide).ok());
  }
};

constexpr curve::Sample kL[] = {{0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.1f, 0}};
constexpr curve::Sample kRingSamples[] = {
    {0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0}, {0, 0, 0}};
constexpr curve::Sample kHairpin[] = {{0, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.004f, 0}, {0, 0.004f, 0}};
constexpr curve::Sample kThree[] = {{0, 0, 0},     {0.2f, 0, 0},  {0.2f, 0.01f, 0},
                                    {0, 0.01f, 0}, {0, 0.02f, 0}, {0.2f, 0.02f, 0}};

void follow(const scene::CurveGuide& guide, math::Vec3 p_m, scene::CurveGuideTouch& touch,
            servo::LocalModel& model) {
  scene::follow_curve(guide, p_m, query::kUnlimited, touch, model);
}
void follow(const scene::SplineGuide& guide, math::Vec3 p_m, scene::SplineGuideTouch& touch,
            servo::LocalModel& model) {
  scene::follow_spline(guide, p_m, query::kUnlimited, touch, model);
}

template <class Guide, class Touch>
struct GuideRig {
  Guide guide;
  Touch touch;
  servo::LocalModel model;
  void set(const scene::Guide& settings) { static_cast<scene::Guide&>(guide) = settings; }
  math::Vec3 force_N(math::Vec3 p_m, math::Vec3 speed_mps = {}) {
    scene::begin_model(model, p_m, 0, 3);
    follow(guide, p_m, touch, model);
    CHECK(servo::is_sound(model));
    return servo::evaluate(model, p_m, speed_mps);
  }
};

using CurveRig = GuideRig<scene::CurveGuide, scene::CurveGuideTouch>;
using SplineRig = GuideRig<scene::SplineGuide, scene::SplineGuideTouch>;

scene::Guide settings() {
  scene::Guide guide;
  guide.pose.translation_m = {0, 0, 0.5f};
  guide.material = {100.0f, 2.0f};
  guide.snap_m = 0.01f;
  guide.release_m = 0.03f;
  return guide;
}

float distance(math::Vec3 a, math::Vec3 b) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

// A walk along the corners and off them, past the ends and back.
math::Vec3 walk(int i) {
  const float t = static_cast<float>(i) * 0.001f;
  return {0.1f + 0.13f * std::sin(3.1f * t),
          0.04f * std::sin(7.3f * t) + 0.03f * std::cos(1.7f * t),
          0.5f + 0.004f * std::sin(11.0f * t)};
}

template <size_t N>
bool is_at_corner(const curve::Sample (&corners)[N], math::Vec3 p) {
  for (const curve::Sample& c : corners)
    if (distance(p, {c.x_m, c.y_m, c.z_m}) < 2e-5f) return true;
  return false;
}

template <size_t N>
void compare(const curve::Sample (&corners)[N], const scene::Guide& with) {
  const SmallCurve small{corners};
  const curve::View sampled = small.view();
  const Splines splines(corners);
  CurveRig a;
  SplineRig b;
  a.set(with);
  b.set(with);
  a.guide.curve = &sampled;
  b.guide.spline = &splines.guide;
  int held = 0, others = 0;
  for (int i = 0; i < 6000; ++i) {
    const math::Vec3 p = walk(i), speed{0.1f, -0.05f, 0.02f};
    const math::Vec3 fa = a.force_N(p, speed), fb = b.force_N(p, speed);
    if (a.touch.is_held && b.touch.is_held) ++held;
    // Two corners of the same cost, or a snap at its edge: the next ticks agree again.
    if (a.touch.is_held != b.touch.is_held ||
        distance(a.touch.closest.point_m, b.touch.closest.point_m) > 2e-6f) {
      ++others;
      b.touch.is_held = a.touch.is_held;
      b.touch.is_off_end = a.touch.is_off_end;
      b.touch.progress_m = a.touch.progress_m;
      b.touch.ahead_m = a.touch.ahead_m;
      continue;
    }
    // At a corner the way along is that of either side.
    if (!is_at_corner(corners, a.touch.closest.point_m)) CHECK_LE(distance(fa, fb), 1e-2f);
    CHECK_LE(std::fabs(a.touch.progress_m - b.touch.progress_m), 5e-4f);
    const float arcs = std::fabs(a.touch.closest.arc - b.touch.closest.arc);
    CHECK_LE(sampled.is_closed() && arcs > 0.5f ? 1 - arcs : arcs, 1e-5f);
    b.touch.progress_m = a.touch.progress_m;
    b.touch.ahead_m = a.touch.ahead_m;
  }
  CHECK_GE(held, 1000);
  CHECK_LE(others, 120);
}

}  // namespace

TEST(SplineOfStraightPieces_GuidesLikeTheSampledCurve) {
  compare(kL, settings());
  compare(kRingSamples, settings());
  compare(kHairpin, settings());
  compare(kThree, settings());
}

TEST(TheSameWithTunnelSideEndsAndDrive) {
  scene::Guide guide = settings();
  guide.tunnel_m = 0.003f;
  compare(kL, guide);
  guide = settings();
  guide.free_side = {0, 1, 0};
  compare(kL, guide);
  guide = settings();
  guide.ends = scene::Ends::kRelease;
  compare(kL, guide);
  guide.ends = scene::Ends::kContinue;
  compare(kHairpin, guide);
  guide = settings();
  guide.drive = {scene::Drive::Kind::kPush, 0.5f, 0, 0.001f};
  compare(kL, guide);
  guide.drive = {scene::Drive::Kind::kLead, 0.5f, 0.05f, 0.001f};
  compare(kL, guide);
  compare(kRingSamples, guide);
}

TEST(ASplineGuideKeepsToItsStrandByThePenalty) {
  const Splines splines(kHairpin);
  for (const float penalty : {0.0f, 0.25f}) {
    SplineRig rig;
    rig.set(settings());
    rig.guide.material.damping_N_s_per_m = 0;
    rig.guide.spline = &splines.guide;
    rig.guide.arc_penalty = penalty;
    CHECK_LE(distance(rig.force_N({0.05f, 0.001f, 0.5f}), {0, -0.1f, 0}), 1e-3f);
    CHECK_LE(distance(rig.force_N({0.05f, 0.003f, 0.5f}), {0, penalty > 0 ? -0.3f : 0.1f, 0}),
             1e-3f);
  }
}

TEST(SplineCircle_ForceHasNoCorner_OpenRingContinues) {
  // A rational quarter, three more, and a gap of half a millimetre.
  tools::SplineCurve c;
  c.degree = 2;
  const double w = std::sqrt(0.5), r = 0.05;
  c.points = {{r, 0, 0, 1},   {r, r, 0, w},  {0, r, 0, 1},  {-r, r, 0, w},     {-r, 0, 0, 1},
              {-r, -r, 0, w}, {0, -r, 0, 1}, {r, -r, 0, w}, {r, -0.0005, 0, 1}};
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.t1 = 4;
  const Splines splines(c);
  SplineRig rig;
  rig.set(settings());
  rig.guide.spline = &splines.guide;
  rig.guide.arc_penalty = 2;
  rig.guide.ends = scene::Ends::kContinue;
  float worst = 0;
  math::Vec3 before;
  for (int i = 0; i <= 3 * 2000; ++i) {
    const double angle = 2 * 3.14159265358979 * (i % 2000) / 2000;
    const math::Vec3 p{static_cast<float>((r + 0.002) * std::cos(angle)),
                       static_cast<float>((r + 0.002) * std::sin(angle)), 0.5f};
    const math::Vec3 now = rig.force_N(p);
    if (i > 0 && i % 2000 > 40 && i % 2000 < 1960) worst = std::max(worst, distance(now, before));
    before = now;
    CHECK(rig.touch.is_held);
    CHECK_LE(rig.touch.closest.distance_m, 0.004f);
  }
  CHECK_LE(worst, 0.2f * 0.00315f * 2);  // 0.2 N that turns by 2 pi / 2000, and rounding
  const double rounds =
      static_cast<double>(rig.touch.progress_m) / static_cast<double>(splines.guide.length_m());
  CHECK_LE(std::fabs(rounds - 3), 0.02);
}
