#pragma once
// Spline surfaces in a scene, for tests: shapes, and a tool that is led about them.
#include <cmath>
#include <vector>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"
#include "spline/orientation.hpp"

namespace firmtouch::spline_touch {

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
    CHECK(tools::open_baked(sections, "x", view).ok());
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
inline Surface torus(bool is_inside_out = false) {
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

// A cube of 40 mm of six bilinear patches: creases everywhere. `inward`: normals that the file
// turns in. `lean`: how far x leans with y, to sharp edges.
inline Surface cube(uint32_t inward = 0, double lean = 0) {
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
          s.points.push_back({at[0] + lean * at[1], at[1], at[2], 1});
        }
      sides.push_back(s);
    }
  return Surface(sides);
}

// A sheet of 80 mm a side in z = 0, free above.
inline Surface sheet() {
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {{-0.04, -0.04, 0, 1}, {0.04, -0.04, 0, 1}, {-0.04, 0.04, 0, 1}, {0.04, 0.04, 0, 1}};
  return Surface({s});
}

// A bicubic sheet of 80 mm a side with waves of 6 mm, free above.
inline Surface waves() {
  tools::SplineSurface s;
  s.degree_u = s.degree_v = 3;
  s.count_u = s.count_v = 8;
  s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5};
  s.u1 = s.v1 = 5;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i)
      s.points.push_back({-0.04 + 0.08 * i / 7, -0.04 + 0.08 * j / 7,
                          0.003 * std::sin(1.7 * i) * std::cos(1.3 * j), 1});
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

inline float apart(math::Vec3 a, math::Vec3 b) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

// A place about the torus's tube: `angle` round the axis, `tilt` round the tube, `off` from it.
inline math::Vec3 on_torus(double angle, double tilt, double off) {
  const double away = 0.05 + (0.02 + off) * std::cos(tilt);
  return {static_cast<float>(away * std::cos(angle)), static_cast<float>(away * std::sin(angle)),
          static_cast<float>((0.02 + off) * std::sin(tilt))};
}

}  // namespace firmtouch::spline_touch
