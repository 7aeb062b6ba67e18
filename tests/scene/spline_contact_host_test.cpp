// Contact with spline surfaces: which side, how deep, which way, and what is never pushed on.
#include <cmath>
#include <vector>

#include "bake/bake_spline.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"
#include "spline/orientation.hpp"

namespace {

namespace math = firmtouch::math;
namespace query = firmtouch::query;
namespace scene = firmtouch::scene;
namespace servo = firmtouch::servo;
namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;

constexpr float kRadius_m = 0.003f;

struct Surface {
  std::vector<tools::Section> sections;
  spline::View view;
  explicit Surface(std::vector<tools::SplineSurface> surfaces) {
    tools::SplineModel model;
    model.surfaces = std::move(surfaces);
    orient(model);
    tools::SplineReport report;
    sections = tools::bake_spline(model, "x", tools::surface_detail(false), report);
    CHECK(spline::open(tools::spline_sections(sections, "x"), view).ok());
  }
};

// A circle of nine points about `middle` in the plane of two axes, times a weight.
struct Ring {
  double x, y, w;
};
constexpr double kHalf = 0.70710678118654752;
constexpr Ring kRing[9] = {{1, 0, 1},      {1, 1, kHalf},  {0, 1, 1},
                           {-1, 1, kHalf}, {-1, 0, 1},     {-1, -1, kHalf},
                           {0, -1, 1},     {1, -1, kHalf}, {1, 0, 1}};
const std::vector<double> kRingKnots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};

// Of radii 50 and 20 mm about the z axis, u round the axis; its normals point out.
Surface torus(bool is_inside_out = false) {
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 2;
  s.count_u = s.count_v = 9;
  s.knots_u = s.knots_v = kRingKnots;
  s.u1 = s.v1 = 4;
  for (const Ring& v : kRing)
    for (const Ring& u : kRing) {
      const double away = 0.05 + 0.02 * v.x, up = is_inside_out ? -0.02 * v.y : 0.02 * v.y;
      s.points.push_back({away * u.x, away * u.y, up, u.w * v.w});
    }
  return Surface({s});
}

// A cube of 40 mm of six bilinear patches: creases everywhere. `inward`: normals that the file turns in.
Surface cube(uint32_t inward = 0) {
  std::vector<tools::SplineSurface> sides;
  const double h = 0.02;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = -1; end <= 1; end += 2) {
      tools::SplineSurface s;
      s.degree_u = s.degree_v = 1;
      s.count_u = s.count_v = 2;
      s.knots_u = s.knots_v = {0, 0, 1, 1};
      s.piece = static_cast<int>(sides.size());
      for (int j = -1; j <= 1; j += 2)
        for (int i = -1; i <= 1; i += 2) {
          double at[3];
          at[axis] = end * h;
          const bool is_in = (inward >> sides.size() & 1u) != 0;
          at[(axis + 1) % 3] = (is_in ? -i : i) * end * h;  // else u x v points out
          at[(axis + 2) % 3] = j * h;
          s.points.push_back({at[0], at[1], at[2], 1});
        }
      sides.push_back(s);
    }
  return Surface(sides);
}

// A sheet of 80 mm a side in z = 0, free above.
Surface sheet() {
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {{-0.04, -0.04, 0, 1}, {0.04, -0.04, 0, 1}, {-0.04, 0.04, 0, 1}, {0.04, 0.04, 0, 1}};
  return Surface({s});
}

struct Rig {
  scene::SplineObject object;
  scene::SplineTouch touch;
  servo::LocalModel model;
  query::Budget budget = query::kUnlimited;
  Rig(const Surface& surface, bool is_closed) {
    object.surface = &surface.view;
    object.material = {1000.0f, 0.0f};
    object.is_closed = is_closed;
  }
  math::Vec3 force_N(math::Vec3 p_m) {
    scene::begin_model(model, p_m, 0, 3);
    scene::touch_spline(object, kRadius_m, p_m, budget, touch, model);
    const bool is_place = p_m.x - p_m.x <= 0.0f && p_m.x < 1e6f;
    CHECK(servo::is_sound(model) || !is_place);
    return servo::evaluate(model, p_m, {});
  }
  // In steps of at most 0.2 mm, as a hand goes.
  math::Vec3 go(math::Vec3 from_m, math::Vec3 to_m) {
    const math::Vec3 way{to_m.x - from_m.x, to_m.y - from_m.y, to_m.z - from_m.z};
    const int steps =
        1 + static_cast<int>(std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z) / 2e-4f);
    math::Vec3 force;
    for (int i = 0; i <= steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      force = force_N({from_m.x + way.x * t, from_m.y + way.y * t, from_m.z + way.z * t});
    }
    return force;
  }
};

float apart(math::Vec3 a, math::Vec3 b) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

// A place about the torus's tube: `angle` round the axis, `tilt` round the tube, `off` from it.
math::Vec3 on_torus(double angle, double tilt, double off) {
  const double away = 0.05 + (0.02 + off) * std::cos(tilt);
  return {static_cast<float>(away * std::cos(angle)), static_cast<float>(away * std::sin(angle)),
          static_cast<float>((0.02 + off) * std::sin(tilt))};
}

}  // namespace

TEST(ASolidOfSplinesPushesOutAlongItsNormalAsDeepAsTheSphereIsIn) {
  for (const bool is_turned : {false, true}) {
    const Surface surface = torus(is_turned);
    Rig rig(surface, true);
    rig.object.is_turned = is_turned;
    for (int i = 0; i < 400; ++i) {
      const double angle = 0.37 * i, tilt = 0.11 * i;
      const double off = 0.002 * std::sin(0.3 * i);  // from 2 mm within to 2 mm outside
      const math::Vec3 p = on_torus(angle, tilt, off);
      const math::Vec3 force = rig.force_N(p);
      const double wanted_N = 1000 * (static_cast<double>(kRadius_m) - off);
      const math::Vec3 wanted{static_cast<float>(wanted_N * std::cos(tilt) * std::cos(angle)),
                              static_cast<float>(wanted_N * std::cos(tilt) * std::sin(angle)),
                              static_cast<float>(wanted_N * std::sin(tilt))};
      if (std::fabs(off) < 1e-6) continue;  // on the surface: by continuity or not at all
      CHECK_LE(apart(force, wanted), 2e-3f * static_cast<float>(wanted_N));
      CHECK_EQ(rig.touch.closest.certificate.sign, off > 0 ? 1 : -1);
    }
  }
}

TEST(TheForceOfASplineSurfaceDoesNotShakeWhereATouchGlidesOverIt) {
  const Surface surface = torus();
  Rig rig(surface, true);
  float worst = 0;
  math::Vec3 before;
  for (int i = 0; i < 4000; ++i) {
    const math::Vec3 now = rig.force_N(on_torus(1e-4 * i, 2e-4 * i, 0.001));
    if (i > 0) worst = std::max(worst, apart(now, before));
    before = now;
  }
  // 2 N that turns by at most 3e-4 rad a tick, and 1 um of the depth.
  CHECK_LE(worst, 2 * 3e-4f + 1e-3f);
}

TEST(OverTheCreasesOfASolidTheForceTurnsWithoutAJump) {
  const Surface surface = cube();
  Rig rig(surface, true);
  (void)rig.go({0, 0, 0.04f}, {0, 0, 0.0215f});
  math::Vec3 before = rig.force_N({0, 0, 0.0215f});
  float worst = 0;
  // Over the edge at x = z = 0.02, 1.5 mm off, then round the corner beyond it.
  std::vector<math::Vec3> way;
  for (int i = 0; i <= 400; ++i) way.push_back({0.02f * static_cast<float>(i) / 400, 0, 0.0215f});
  for (int i = 0; i <= 200; ++i) {
    const double a = 1.5707963 * i / 200;
    way.push_back({static_cast<float>(0.02 + 0.0015 * std::sin(a)), 0,
                   static_cast<float>(0.02 + 0.0015 * std::cos(a))});
  }
  for (int i = 0; i <= 400; ++i)
    way.push_back({0.0215f, 0.0199f * static_cast<float>(i) / 400,
                   0.02f - 0.01f * static_cast<float>(i) / 400});
  for (const math::Vec3& p : way) {
    const math::Vec3 now = rig.force_N(p);
    CHECK_EQ(rig.touch.closest.certificate.sign, 1);
    CHECK_LE(std::fabs(std::sqrt(now.x * now.x + now.y * now.y + now.z * now.z) - 1.5f), 5e-3f);
    worst = std::max(worst, apart(now, before));
    before = now;
  }
  CHECK_LE(worst, 0.06f);
}

TEST(ASolidWhoseNormalsPointToBothSidesFeelsAsIfTheyPointedToOne) {
  for (const uint32_t inward : {0x01u, 0x02u, 0x18u, 0x24u}) {
    const Surface sound = cube(), mixed = cube(inward);
    Rig a(sound, true), b(mixed, true);
    math::Vec3 at{0, 0, 0.04f};
    for (int i = 0; i < 3000; ++i) {
      const float t = 0.004f * static_cast<float>(i);
      at = {0.024f * std::sin(t), 0.024f * std::sin(2.1f * t + 1), 0.024f * std::cos(0.7f * t)};
      const math::Vec3 fa = a.force_N(at), fb = b.force_N(at);
      if (a.touch.closest.piece != b.touch.closest.piece) continue;  // two sides equally near
      CHECK_LE(apart(fa, fb), 2e-3f + 1e-3f * apart(fa, {}));
      CHECK_EQ(a.touch.closest.certificate.sign, b.touch.closest.certificate.sign);
    }
  }
}

TEST(ASideIsToldInsideAConvexAndAConcaveCornerOfASolid) {
  const Surface surface = cube();
  Rig rig(surface, true);
  const math::Vec3 in = rig.go({0, 0, 0.03f}, {0.019f, 0.019f, 0.0185f});
  CHECK_EQ(rig.touch.closest.certificate.sign, -1);
  CHECK_GE(in.x + in.y + in.z, 3.0f);  // out, by the nearest side
  Rig cold(surface, true);             // without a past the sides of its faces are told as well
  (void)cold.force_N({0.01f, 0.005f, 0.019f});
  CHECK_EQ(cold.touch.closest.certificate.sign, -1);
}

TEST(AnUnknownSideOfASplineIsNeverPushedOn) {
  const Surface surface = torus();
  for (uint32_t steps = 1; steps < 60; ++steps) {
    Rig rig(surface, true);
    rig.budget.steps = steps;
    for (int i = 0; i < 30; ++i) {
      rig.touch.hint = {};
      const double off = 0.004 * std::sin(1.0 + i);
      const math::Vec3 force = rig.force_N(on_torus(0.8 * i, 0.4 * i, off));
      const scene::SplineTouch& t = rig.touch;
      if (t.closest.certificate.sign == 0) CHECK_EQ(t.penetration_m, 0.0f);
      if (!t.closest.certificate.exact) CHECK_EQ(t.closest.certificate.sign, 0);
      const float size = std::sqrt(force.x * force.x + force.y * force.y + force.z * force.z);
      CHECK_LE(size, 1000 * static_cast<float>(0.003 - off) + 2e-3f +
                         (off > 0.003 ? 1000 * static_cast<float>(off - 0.003) : 0));
    }
  }
  // A vertex of a cube, cold, from the diagonal: no normal is along the line, so no side, no force.
  const Surface corner = cube();
  Rig rig(corner, true);
  CHECK_EQ(apart(rig.force_N({0.0205f, 0.0205f, 0.0205f}), {}), 0.0f);
  CHECK_EQ(rig.touch.closest.certificate.sign, 0);
  (void)rig.go({0.03f, 0.0f, 0.0f}, {0.03f, 0.03f, 0.03f});
  CHECK_GE(apart(rig.go({0.03f, 0.03f, 0.03f}, {0.0205f, 0.0205f, 0.0205f}), {}), 1.0f);
}

TEST(ASheetIsFeltFromItsFreeSideOnly) {
  const Surface surface = sheet();
  Rig rig(surface, false);
  CHECK_LE(apart(rig.go({0, 0, 0.01f}, {0, 0, 0.001f}), {0, 0, 2}), 2e-3f);
  CHECK_LE(apart(rig.go({0, 0, 0.001f}, {0.01f, 0, -0.001f}), {0, 0, 4}), 4e-3f);  // pressed in
  CHECK_LE(apart(rig.go({0.01f, 0, -0.001f}, {0.01f, 0, -0.006f}), {}), 0.0f);  // through: let go
  CHECK_LE(apart(rig.go({0.01f, 0, -0.006f}, {0.01f, 0, 0.002f}), {}),
           0.0f);  // from behind: nothing
  CHECK_LE(apart(rig.go({0.01f, 0, 0.002f}, {0.01f, 0, 0.004f}), {}), 0.0f);  // clear now
  CHECK_LE(apart(rig.go({0.01f, 0, 0.004f}, {0.01f, 0, 0.002f}), {0, 0, 1}), 2e-3f);
  Rig turned(surface, false);
  turned.object.is_turned = true;
  CHECK_LE(apart(turned.go({0, 0, 0.01f}, {0, 0, 0.001f}), {}), 0.0f);
  CHECK_LE(apart(turned.go({0, 0, -0.01f}, {0, 0, -0.001f}), {0, 0, -2}), 2e-3f);
}

TEST(OverTheBorderOfASheetTheForceFallsOffAndRoundItNothingIsFelt) {
  const Surface surface = sheet();
  Rig rig(surface, false);
  (void)rig.go({0, 0, 0.01f}, {0, 0, 0.001f});
  math::Vec3 before = rig.go({0, 0, 0.001f}, {0.039f, 0, 0.001f});
  float worst = 0;
  for (int i = 0; i <= 500; ++i) {  // out over the border
    const math::Vec3 now = rig.force_N({0.039f + 1e-5f * static_cast<float>(i), 0, 0.001f});
    worst = std::max(worst, apart(now, before));
    before = now;
  }
  CHECK_LE(worst,
           0.07f);  // 2 N that turns by 0.01 rad a step, and three times that where it fades in
  CHECK_LE(apart(before, {}), 0.0f);
  CHECK_LE(apart(rig.go({0.044f, 0, 0.001f}, {0.044f, 0, -0.002f}), {}), 0.0f);
  CHECK_LE(apart(rig.go({0.044f, 0, -0.002f}, {0.03f, 0, -0.002f}), {}), 0.0f);
}

TEST(HostileTouchesOfSplinesLeaveASoundModel) {
  const Surface surface = torus();
  const float bad[] = {__builtin_nanf(""), __builtin_inff(), -__builtin_inff(), 3e38f, 1e-45f};
  for (const float value : bad)
    for (const bool is_closed : {false, true}) {
      Rig rig(surface, is_closed);
      (void)rig.force_N(on_torus(0, 0, 0.001));
      (void)rig.force_N({value, 0, 0});
      (void)rig.force_N({value, value, -value});
      CHECK_EQ(rig.model.plane_count, value < 1 && value > 0 ? rig.model.plane_count : 0u);
      rig.touch.hint.place = 0xFFFFFFFEu;
      rig.touch.hint.position_m.x = value;
      const math::Vec3 force = rig.force_N(on_torus(0, 0, 0.001));
      CHECK(force.x - force.x <= 0.0f);
    }
  Rig none(surface, true);
  none.object.surface = nullptr;
  CHECK_EQ(apart(none.force_N({0, 0, 0}), {}), 0.0f);
}
