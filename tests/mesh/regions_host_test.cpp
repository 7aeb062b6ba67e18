// Sides where features meet: an ulp to either side of every border between the regions of faces,
// edges and vertices, on the medial axis, and on the surface itself.
#include <algorithm>
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "bake/mesh/sign_margin.hpp"
#include "bake/mesh/stars.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/point.hpp"
#include "surface/winding_number.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using tools::Point;

struct Solid {
  tools::Surface surface;
  tools::ExactNormals exact;
  tools::WindingNumber winding;
  std::vector<tools::Section> sections;
  mesh::View view;
  double size;

  explicit Solid(tools::Surface from)
      : surface(std::move(from)),
        exact(surface),
        winding(surface, {}),
        size(mesh_test::diagonal(surface)) {
    tools::MeshOptions as_given;  // the features are those of the surface
    as_given.max_growth = 0;
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "solid", as_given, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "solid", view).ok());
  }
  Point vertex(uint32_t v) const { return tools::to_point(surface.vertices[v]); }
  Point corner(uint32_t h) const { return vertex(surface.faces[h / 3][h % 3]); }
  Point end(uint32_t h) const { return vertex(surface.faces[h / 3][(h % 3 + 1) % 3]); }
};

Point unit(Point a) { return a * (1 / length(a)); }

// The sides of the point and of its 26 neighbours an ulp away.
uint32_t check_around(const Solid& solid, Point at, mesh::Hint& hint) {
  const Vec3 p = tools::to_vec3(at);
  uint32_t checked = 0;
  for (int i = 0; i < 27; ++i) {
    const auto step = [](float x, int by) {
      return by == 1 ? x : std::nextafter(x, by == 0 ? -HUGE_VALF : HUGE_VALF);
    };
    const Vec3 q{step(p.x, i % 3), step(p.y, i / 3 % 3), step(p.z, i / 9)};
    const mesh::Closest c = mesh::closest_point(solid.view, q, query::kUnlimited, hint);
    if (!(std::fabs(double{c.distance_m}) > 2.5e-6 * solid.size)) continue;
    ++checked;
    CHECK(c.certificate.exact);
    CHECK_EQ(c.certificate.sign, solid.winding.at(tools::to_point(q)) != 0 ? -1 : 1);
  }
  return checked;
}

// Borders of face and edge: above the middle of the edge along each face's normal. Of edge and
// vertex: from the vertex within the wedge of the edge. Of all three: the extreme rays.
void check_borders(const Solid& solid, uint32_t every) {
  mesh::Hint hint;
  uint32_t checked = 0;
  for (const double reach : {1e-5, 1e-3, 0.02}) {
    const double t = reach * solid.size;
    for (uint32_t h = 0; h < 3 * solid.surface.faces.size(); h += every) {
      test::note("half-edge", h);
      const Point middle = (solid.corner(h) + solid.end(h)) * 0.5,
                  normal = solid.exact.faces[h / 3];
      const Point wedge = unit(solid.exact.of_edge(h));
      for (const double side : {t, -t}) {
        checked += check_around(solid, middle + normal * side, hint);
        checked += check_around(solid, solid.corner(h) + normal * side, hint);
        checked += check_around(solid, solid.corner(h) + wedge * side, hint);
      }
    }
    const tools::Stars stars(solid.surface, solid.exact);
    for (uint32_t v = 0; v < solid.surface.vertices.size(); v += every) {
      test::note("vertex", v);
      for (const tools::SideRay& ray : tools::extreme_rays(stars.around(v)))
        checked += check_around(solid, solid.vertex(v) + ray.direction * t, hint);
    }
  }
  CHECK_GT(checked, 1000u);
}

// The closest points of p that tie to within a billionth.
struct Ties {
  double distance = HUGE_VAL;
  std::vector<Point> points;
};
Ties ties_of(const Solid& solid, Point p) {
  Ties ties;
  std::vector<std::pair<double, Point>> all;
  for (const tools::Face& f : solid.surface.faces) {
    const Point q =
        tools::closest_of(p, solid.vertex(f[0]), solid.vertex(f[1]), solid.vertex(f[2]));
    const Point r = q - p;
    if (length(r) > ties.distance + 1e-9 * solid.size) continue;
    all.push_back({length(r), q});
    ties.distance = std::min(ties.distance, length(r));
  }
  for (const auto& [distance, q] : all) {
    bool is_new = distance <= ties.distance + 1e-9 * solid.size;
    for (const Point& other : ties.points) is_new = is_new && length(other - q) > 1e-6 * solid.size;
    if (is_new) ties.points.push_back(q);
  }
  return ties;
}

// The sign that the firmware returns for `p` when the foot `q` is the nearest: from a point so near
// to it on the way to `p` that no other is, along which the side is the same.
int side_by_foot(const Solid& solid, Point p, Point q) {
  mesh::Hint hint;
  const mesh::Closest c =
      mesh::closest_point(solid.view, tools::to_vec3(q + (p - q) * 0.5), query::kUnlimited, hint);
  CHECK_LE(length(tools::to_point(c.point_m) - q), 1e-3 * solid.size);
  return dot(p - q, tools::to_point(c.direction)) < 0 ? -1 : 1;
}

}  // namespace

TEST(AnUlpToEitherSideOfEveryBorderTheSideIsRight) {
  check_borders(Solid(tools::make_part(1, 2000)), mesh_test::long_run() ? 1 : 29);
}

TEST(AnUlpToEitherSideOfBordersOfRealModelsTheSideIsRight) {
  if (mesh_test::models_folder().empty())
    return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  for (const char* name : {"spot.obj", "rocker-arm.off", "fandisk.obj"}) {
    const tools::Surface surface = mesh_test::real_model(name);
    if (!surface.faces.empty()) check_borders(Solid(surface), mesh_test::long_run() ? 1 : 499);
  }
}

// From a foot along its offset until another foot is as near: there every nearest feature must give
// the same sign.
TEST(MedialAxis_AllTiedFeaturesGiveOneSign) {
  const Solid solid(tools::make_part(1, 1000));
  tools::Random random(12);
  uint32_t found = 0;
  for (int i = 0; i < (mesh_test::long_run() ? 2000 : 60); ++i) {
    test::note("case", i);
    const Point start{random.between(-0.05, 0.05), random.between(-0.05, 0.05),
                      random.between(-0.02, 0.02)};
    const Ties one = ties_of(solid, start);
    if (one.points.size() != 1 || one.distance < 1e-4 * solid.size) continue;
    const Point foot = one.points[0], along = unit(start - foot);
    double low = one.distance, high = solid.size;
    const auto is_nearest = [&](double t) {
      return ties_of(solid, foot + along * t).distance > t - 1e-10 * solid.size;
    };
    if (is_nearest(high)) continue;  // outward to infinity
    for (int k = 0; k < 45; ++k) {
      const double middle = 0.5 * (low + high);
      (is_nearest(middle) ? low : high) = middle;
    }
    const Point axis = foot + along * low;
    const Ties ties = ties_of(solid, axis);
    if (ties.points.size() < 2) continue;  // a border of regions, not two feet
    ++found;
    const int side = solid.winding.at(axis) != 0 ? -1 : 1;
    for (const Point& q : ties.points) CHECK_EQ(side_by_foot(solid, axis, q), side);
    mesh::Hint hint;
    CHECK_EQ(mesh::closest_point(solid.view, tools::to_vec3(axis), query::kUnlimited, hint)
                 .certificate.sign,
             side);
  }
  CHECK_GT(found, 10u);
}

// At the centre of a cube six faces tie, on its diagonals three; the distances are exact.
TEST(CubeMedialAxis_EveryNearestFaceGivesInside) {
  tools::Surface cube;
  for (uint32_t v = 0; v < 8; ++v)
    cube.vertices.push_back({v & 1 ? 1.0f : -1.0f, v & 2 ? 1.0f : -1.0f, v & 4 ? 1.0f : -1.0f});
  cube.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const Solid solid(cube);
  mesh::Hint hint;
  for (const float t : {0.0f, 0.25f, 0.5f, 0.875f, 0.9375f})
    for (const float x : {t, -t})
      for (const float y : {t, -t})
        (void)check_around(solid, {double{x}, double{y}, double{t}}, hint);
}

// On the surface the sign means nothing; feature and direction are returned. A step along the
// direction leads out, a step back leads in. A query at a corner returns the corner; one that
// float32 puts beside the middle of an edge may return a face of it.
TEST(OnTheSurface_FeatureAndDirectionAreRight) {
  const Solid solid(tools::make_part(1, 2000));
  const tools::Stars stars(solid.surface, solid.exact);
  mesh::Hint hint;
  uint32_t edges = 0;
  const auto check = [&](Vec3 at) {
    const mesh::Closest c = mesh::closest_point(solid.view, at, query::kUnlimited, hint);
    CHECK_LE(std::fabs(double{c.distance_m}), 4e-7 * solid.size);
    const Point p = tools::to_point(at), n = tools::to_point(c.direction);
    CHECK_LE(std::fabs(length(n) - 1), 1e-6);
    CHECK_EQ(solid.winding.at(p + n * (1e-5 * solid.size)), 0);
    CHECK_EQ(solid.winding.at(p - n * (1e-5 * solid.size)), 1);
    return c;
  };
  for (uint32_t v = 0; v < solid.surface.vertices.size(); ++v) {
    test::note("vertex", v);
    const mesh::Closest c = check(solid.surface.vertices[v]);
    CHECK(mesh::is_vertex(c.feature));
    CHECK_LE(length(tools::to_point(c.direction) - solid.exact.vertices[v]), 0.02);
  }
  for (uint32_t h = 0; h < 3 * solid.surface.faces.size(); ++h) {
    test::note("half-edge", h);
    const mesh::Closest c = check(tools::to_vec3((solid.corner(h) + solid.end(h)) * 0.5));
    CHECK(!mesh::is_vertex(c.feature));
    if (mesh::is_edge(c.feature)) {
      ++edges;
      CHECK_LE(length(tools::to_point(c.direction) - unit(solid.exact.of_edge(h))), 0.02);
    }
    if (h % 3 == 0) {
      const Point middle =
          (solid.corner(h) + solid.corner(h + 1) + solid.corner(h + 2)) * (1.0 / 3);
      CHECK(check(tools::to_vec3(middle)).feature == mesh::Feature::kFace);
    }
  }
  CHECK_GT(edges, 100u);
}
