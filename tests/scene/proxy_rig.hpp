#pragma once
// Meshes with corners, slots and thin plates, and a proxy whose every move is observed.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/proxy.hpp"
#include "harness/test.hpp"
#include "surface/surface.hpp"

namespace firmtouch::scene_test {

using math::Vec3;

struct Profile {
  std::vector<std::array<float, 2>> points;  // (x, z), counterclockwise
  std::vector<std::array<uint32_t, 3>> triangles;
};

// A profile drawn along y from -half_m to half_m.
inline void extrude(const Profile& profile, float half_m, tools::Surface& surface) {
  const uint32_t first = static_cast<uint32_t>(surface.vertices.size()),
                 n = static_cast<uint32_t>(profile.points.size());
  for (const float y : {-half_m, half_m})
    for (const std::array<float, 2>& p : profile.points)
      surface.vertices.push_back({p[0], y, p[1]});
  for (const std::array<uint32_t, 3>& t : profile.triangles) {
    surface.faces.push_back({first + t[0], first + t[1], first + t[2]});
    surface.faces.push_back({first + n + t[0], first + n + t[2], first + n + t[1]});
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    surface.faces.push_back({first + i, first + n + i, first + j});
    surface.faces.push_back({first + j, first + n + i, first + n + j});
  }
  surface.source.clear();
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
}

inline Profile rectangle(float x0, float x1, float z0, float z1) {
  return {{{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}}, {{0, 1, 2}, {0, 2, 3}}};
}

// Floor z = 0 for x < 0, wall x = 0 above it.
inline tools::Surface two_walls() {
  tools::Surface surface;
  extrude({{{-0.06f, 0}, {-0.06f, -0.03f}, {0.03f, -0.03f}, {0.03f, 0.04f}, {0, 0.04f}, {0, 0}},
           {{0, 1, 2}, {0, 2, 5}, {5, 2, 3}, {5, 3, 4}}},
          0.06f, surface);
  return surface;
}

// A right-angled V along y with its bottom at z = -0.01.
inline tools::Surface groove() {
  tools::Surface surface;
  extrude({{{-0.04f, 0},
            {-0.04f, -0.03f},
            {0.04f, -0.03f},
            {0.04f, 0},
            {0.01f, 0},
            {0, -0.01f},
            {-0.01f, 0}},
           {{0, 1, 6}, {6, 1, 5}, {5, 1, 2}, {5, 2, 4}, {4, 2, 3}}},
          0.06f, surface);
  return surface;
}

// Level at z = 0, with a slot of that width along y.
inline tools::Surface slot(float width_m) {
  tools::Surface surface;
  extrude(rectangle(-0.05f, -width_m / 2, -0.02f, 0), 0.03f, surface);
  extrude(rectangle(width_m / 2, 0.05f, -0.02f, 0), 0.03f, surface);
  return surface;
}

inline tools::Surface plate(float thickness_m) {
  tools::Surface surface;
  extrude(rectangle(-0.04f, 0.04f, -thickness_m, 0), 0.04f, surface);
  return surface;
}

// The axis of a drum: skew, so that no coordinate is exact.
constexpr Vec3 kDrumAxis{0.48f, 0.64f, 0.6f};

// A drum whose ends are fans: on its axis as many triangles as it has sides are nearest.
inline tools::Surface drum(float radius_m, float half_m, uint32_t sides) {
  tools::Surface surface;
  const auto add = [&surface](double x, double y, double z) {
    surface.vertices.push_back({static_cast<float>(0.36 * x - 0.8 * y + 0.48 * z),
                                static_cast<float>(0.48 * x + 0.6 * y + 0.64 * z),
                                static_cast<float>(-0.8 * x + 0.6 * z)});
  };
  const double radius = static_cast<double>(radius_m), half = static_cast<double>(half_m);
  add(0, 0, -half), add(0, 0, half);
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979 * i / sides;
    for (const double z : {-half, half}) add(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    surface.faces.push_back({0, b, a});
    surface.faces.push_back({1, a + 1, b + 1});
    surface.faces.push_back({a, b, a + 1});
    surface.faces.push_back({a + 1, b, b + 1});
  }
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

// A tube along y, with a bore of `sides` flat sides that touch a cylinder of that radius.
inline tools::Surface tube(float bore_m, float half_m, uint32_t sides) {
  tools::Surface surface;
  const double pi = 3.14159265358979, corner_m = static_cast<double>(bore_m) / std::cos(pi / sides);
  for (uint32_t i = 0; i < sides; ++i) {
    const double x = std::cos(2 * pi * i / sides), z = std::sin(2 * pi * i / sides);
    for (const double radius_m : {corner_m, 2 * corner_m})
      for (const float y : {-half_m, half_m})
        surface.vertices.push_back(
            {static_cast<float>(radius_m * x), y, static_cast<float>(radius_m * z)});
  }
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t a = 4 * i, b = 4 * ((i + 1) % sides);
    const uint32_t ring[4] = {0, 1, 3, 2};  // inside back, inside front, outside front, ...
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t near = ring[k], next = ring[(k + 1) % 4];
      surface.faces.push_back({a + near, b + near, a + next});
      surface.faces.push_back({a + next, b + near, b + next});
    }
  }
  for (uint32_t i = 0; i < surface.faces.size(); ++i) surface.source.push_back(i);
  return surface;
}

// What a tick may have broken.
struct Broken {
  uint32_t crossings = 0, unclear = 0, longer = 0, late = 0, over_budget = 0, optimal = 0,
           queries = 0, ticks = 0;
  double worst_longer_m = 0;
};

struct ProxyRig {
  std::vector<tools::Section> sections;
  mesh::View view;
  scene::MeshObject object;
  mesh::Hint hint;
  scene::Proxy proxy;
  scene::ProxySettings settings;
  scene::ProxyMoved moved;

  explicit ProxyRig(const tools::Surface& surface, bool is_signed = true) {
    tools::MeshReport report;
    tools::MeshOptions options;
    options.is_signed = is_signed;
    sections = tools::bake_mesh(surface, "shape", options, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "shape", view).ok());
    object.mesh = &view;
    settings.radius_m = 0.003f;
  }

  static double wide(float a) { return static_cast<double>(a); }
  static double distance(Vec3 a, Vec3 b) {
    return std::hypot(wide(a.x) - wide(b.x), wide(a.y) - wide(b.y), wide(a.z) - wide(b.z));
  }

  // Least distance of a point to all triangles, in double: an oracle of its own (projection on the
  // plane, else the edges).
  double truth_m(Vec3 p_m) const {
    double least = 1e300;
    for (uint32_t i = 0; i < view.head().triangle_count; ++i) {
      const auto corners = view.triangle(i);
      double v[3][3], p[3] = {wide(p_m.x), wide(p_m.y), wide(p_m.z)};
      for (int k = 0; k < 3; ++k) {
        const Vec3 c = view.vertex(corners.corner[k]);
        v[k][0] = wide(c.x), v[k][1] = wide(c.y), v[k][2] = wide(c.z);
      }
      least = std::fmin(least, triangle_m(p, v));
    }
    return least;
  }

  void tick(Vec3 hand_m, Broken& broken) {
    const bool was_free = proxy.phase == scene::Proxy::Phase::kFree;
    const Vec3 begin_m = proxy.position_m;
    const scene::MeshTouched shape{object, hint};
    scene::ProxyMove move(settings, shape.size_m(), hand_m, proxy);
    // Each move is straight, all of a tick together need not be.
    Vec3 before_m = begin_m;
    const auto note = [&] {
      if (was_free) note_move(before_m, broken);
      before_m = proxy.position_m;
    };
    for (; move.aim(); note()) move.take(scene::nearest_of(shape, move));
    note();
    moved = move.finish();
    ++broken.ticks;
    broken.queries += moved.queries;
    broken.optimal += moved.is_optimal ? 1 : 0;
    if (moved.queries > scene::kMaxQueries || moved.work > settings.budget.work)
      ++broken.over_budget;
    if (proxy.phase != scene::Proxy::Phase::kFree) return;
    if (was_free) {
      const double longer_m = distance(proxy.position_m, hand_m) - distance(begin_m, hand_m);
      if (longer_m > 0) ++broken.longer;
      broken.worst_longer_m = std::fmax(broken.worst_longer_m, longer_m);
    }
    if (broken.ticks % 16 == 0 &&
        truth_m(proxy.position_m) < wide(proxy.radius_m) - 2e-6 * wide(view.head().diagonal_m))
      ++broken.unclear;
  }

 private:
  static double segment_m(const double (&p)[3], const double (&a)[3], const double (&b)[3]) {
    double ab2 = 0, t = 0;
    for (int k = 0; k < 3; ++k) ab2 += (b[k] - a[k]) * (b[k] - a[k]);
    for (int k = 0; k < 3; ++k) t += (p[k] - a[k]) * (b[k] - a[k]);
    t = ab2 > 0 ? std::fmin(1.0, std::fmax(0.0, t / ab2)) : 0;
    double d2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = p[k] - (a[k] + t * (b[k] - a[k]));
      d2 += off * off;
    }
    return std::sqrt(d2);
  }
  static double triangle_m(const double (&p)[3], const double (&v)[3][3]) {
    double least = std::fmin(segment_m(p, v[0], v[1]),
                             std::fmin(segment_m(p, v[1], v[2]), segment_m(p, v[2], v[0])));
    double u[3], w[3], n[3], n2 = 0, height = 0;
    for (int k = 0; k < 3; ++k) u[k] = v[1][k] - v[0][k], w[k] = v[2][k] - v[0][k];
    for (int k = 0; k < 3; ++k)
      n[k] = u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3];
    for (int k = 0; k < 3; ++k) n2 += n[k] * n[k], height += n[k] * (p[k] - v[0][k]);
    if (!(n2 > 0)) return least;
    for (int i = 0; i < 3; ++i) {  // is the foot on the inner side of every edge?
      const double(&a)[3] = v[i], (&b)[3] = v[(i + 1) % 3];
      double side = 0;
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        side += n[k] * ((b[l] - a[l]) * (p[m] - a[m]) - (b[m] - a[m]) * (p[l] - a[l]));
      }
      if (side < 0) return least;
    }
    return std::fmin(least, std::fabs(height) / std::sqrt(n2));
  }
  void note_move(Vec3 before_m, Broken& broken) const {
    if (!(distance(before_m, proxy.position_m) > 0)) return;
    const mesh::Hit hit = mesh::any_crossing(view, before_m, proxy.position_m, query::kUnlimited);
    if (hit.hit || !hit.exact) ++broken.crossings;
  }
};

}  // namespace firmtouch::scene_test
