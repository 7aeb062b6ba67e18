// What the baker proves of the stored pseudonormals: that it finds each that gives a wrong sign,
// and what it does where no normal can be right.
#include <algorithm>
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "bake/mesh/sign_margin.hpp"
#include "bake/mesh/sign_proof.hpp"
#include "bake/mesh/stars.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/shapes.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using tools::Point;

Point unit(Point a) { return a * (1 / length(a)); }

// Ordered edges of a corner that goes once around the z axis, of any depth, and their own normals.
std::vector<tools::StarEdge> random_star(tools::Random& random) {
  const uint32_t count = 3 + random.below(6);
  std::vector<Point> e;
  for (uint32_t k = 0; k < count; ++k) {
    const double turn = 2 * M_PI * (k + random.between(0, 0.4)) / count,
                 polar = random.between(1.0, 3.0);
    e.push_back(
        {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)});
  }
  std::vector<tools::StarEdge> star;
  for (uint32_t k = 0; k < count; ++k)
    star.push_back({e[k], unit(cross(e[k], e[(k + 1) % count])) +
                              unit(cross(e[(k + count - 1) % count], e[k]))});
  return star;
}

// Inside and outside of a corner, by whether the ray from its axis's end meets an even number of
// faces on the way: no normals.
bool is_outside(const std::vector<tools::StarEdge>& star, Point r) {
  int crossings = 0;
  const Point top{1e-3, 2e-3, 1};  // outside: every edge lies below
  for (size_t k = 0; k < star.size(); ++k) {
    const Point a = star[k].direction, b = star[(k + 1) % star.size()].direction;
    const Point n = cross(a, b);
    const double from = dot(n, top), to = dot(n, r);
    if ((from > 0) == (to > 0)) continue;
    const Point at = top * std::fabs(to) + r * std::fabs(from);
    if (dot(cross(n, a), at) > 0 && dot(cross(b, n), at) > 0) ++crossings;
  }
  return crossings % 2 == 0;
}

struct Proven {
  tools::Surface surface;
  tools::ExactNormals exact;
  tools::Pseudonormals stored;
  explicit Proven(tools::Surface from)
      : surface(std::move(from)), exact(surface), stored(make_pseudonormals(surface, exact)) {}
  tools::SignProof proof() const {
    return prove_signs(surface, exact, stored, tools::kMinMargin_rad, {});
  }
};

}  // namespace

// The cone by sampling: its points have the extreme rays' side, the least margin of the rays is the
// least of all, and the angle-weighted normal of the corner has a margin.
TEST(ExtremeRaysBoundTheMarginOfTheWholeCone) {
  tools::Random random(3);
  int sampled = 0;
  for (int i = 0; i < 3000; ++i) {
    test::note("case", i);
    const std::vector<tools::StarEdge> star = random_star(random);
    const std::vector<tools::SideRay> rays = tools::extreme_rays(star);
    const Point normal = unit({random.bell() * 0.3, random.bell() * 0.3, 1});
    const double margin = tools::vertex_margin(rays, normal);
    double least = 1;
    for (int k = 0; k < 300; ++k) {
      const Point r = unit({random.bell(), random.bell(), random.bell()});
      bool in_cone = true;
      for (const tools::StarEdge& edge : star) in_cone = in_cone && dot(edge.direction, r) <= 0;
      if (!in_cone) continue;
      ++sampled;
      CHECK(!rays.empty());
      const int side = is_outside(star, r) ? 1 : -1;
      for (const tools::SideRay& ray : rays) CHECK_EQ(ray.side, side);
      least = std::min(least, side * dot(normal, r));
    }
    if (margin > 0) CHECK_GE(least, margin - 1e-12);
  }
  CHECK_GT(sampled, 3000);
}

TEST(AFlatVertexHasBothItsSides) {
  std::vector<tools::StarEdge> star;
  for (int k = 0; k < 6; ++k)
    star.push_back({{std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0}, {0, 0, 2}});
  const std::vector<tools::SideRay> rays = tools::extreme_rays(star);
  bool up = false, down = false;
  for (const tools::SideRay& ray : rays) {
    CHECK_LE(std::fabs(std::fabs(ray.direction.z) - 1), 1e-12);
    CHECK_EQ(ray.side, ray.direction.z > 0 ? 1 : -1);
    (ray.side > 0 ? up : down) = true;
  }
  CHECK(up && down);
  CHECK_GE(tools::vertex_margin(rays, {0, 0, 1}), 1 - 1e-12);
}

// A pyramid of n even sides: the normals lean up by the sine s, so that the axis may turn by that.
TEST(MarginOfAnEvenPyramidHasAClosedForm) {
  for (const int n : {3, 4, 7, 100, 1000}) {
    std::vector<Point> e;
    for (int k = 0; k < n; ++k)
      e.push_back(unit({0.3 * std::cos(2 * M_PI * k / n), 0.3 * std::sin(2 * M_PI * k / n), -1}));
    std::vector<tools::StarEdge> star;
    for (int k = 0; k < n; ++k)
      star.push_back(
          {e[static_cast<size_t>(k)],
           unit(cross(e[static_cast<size_t>(k)], e[static_cast<size_t>((k + 1) % n)])) +
               unit(cross(e[static_cast<size_t>((k + n - 1) % n)], e[static_cast<size_t>(k)]))});
    const double inner = 0.3 * std::cos(M_PI / n), sine = inner / std::sqrt(1 + inner * inner);
    CHECK_LE(std::fabs(tools::vertex_margin(tools::extreme_rays(star), {0, 0, 1}) - sine), 1e-9);
  }
}

// A cone of 20,000 sides takes seconds, not hours, and is not refused.
TEST(AFinelyCutConeIsProven) {
  tools::Surface cone;
  constexpr uint32_t kSides = 20000;
  cone.vertices = {{0, 0, 1}, {0, 0, 0}};
  for (uint32_t k = 0; k < kSides; ++k)
    cone.vertices.push_back(tools::to_vec3(
        {0.5 * std::cos(2 * M_PI * k / kSides), 0.5 * std::sin(2 * M_PI * k / kSides), 0}));
  for (uint32_t k = 0; k < kSides; ++k) {
    const uint32_t here = 2 + k, next = 2 + (k + 1) % kSides;
    cone.faces.push_back({0, here, next});
    cone.faces.push_back({1, next, here});
  }
  const Proven proven(std::move(cone));
  const tools::SignProof proof = proven.proof();
  CHECK(proof.holds());
  CHECK_GT(proof.vertices.smallest_rad, 0.4);  // atan(0.5) at the tip, less what thinning takes
}

// The rim of a cylinder, where a flat cap is a fan of thousands of triangles: beyond the fan lies
// one edge of the wall, and without it the cone would have the cap's lower side, too.
TEST(FanInAFlatFace_HasTheConeOfItsRim) {
  for (const int n : {70, 999, 2000, 20000}) {
    std::vector<tools::StarEdge> fan;
    for (int k = 0; k <= n; ++k) {
      const bool is_rim = k == 0 || k == n;
      fan.push_back({{std::cos(M_PI * k / n), std::sin(M_PI * k / n), 0},
                     is_rim ? Point{0, -1, 1} : Point{0, 0, 2}});
    }
    for (int at = 0; at < n; at += n / 5 + 1) {
      test::note("edges", n);
      test::note("edge of the wall", at);
      std::vector<tools::StarEdge> star = fan;
      star.insert(star.begin() + at, tools::StarEdge{{0, 0, -1}, {0, -2, 0}});
      const std::vector<tools::SideRay> rays = tools::extreme_rays(star);
      const double sine = tools::vertex_margin(rays, unit({0, -1, 1}));
      CHECK_LE(std::fabs(sine - std::sqrt(0.5)), 1e-9);
    }
  }
}

TEST(NanMargin_IsTheWorst) {
  const double nan = std::nan("");
  CHECK_LE(tools::vertex_margin({{{0, 0, 1}, 1}}, {0, 0, nan}), -1.0);
  CHECK_LE(tools::edge_margin({0, 0, 1}, {0, 1, 0}, {nan, 0, 0}), -1.0);
}

// The opposite of a vertex's normal is wrong wherever the vertex can be the closest point; an
// edge's normal in the plane of a face has no margin to it.
TEST(EveryWrongCodeIsFound) {
  const Proven sound(tools::make_part(1, 500));
  CHECK(sound.proof().holds());
  tools::ExactNormals opposite = sound.exact;
  for (Point& normal : opposite.vertices) normal = normal * -1.0;
  const tools::Pseudonormals wrong = make_pseudonormals(sound.surface, opposite);
  const tools::Stars stars(sound.surface, sound.exact);
  uint32_t planted = 0;
  for (uint32_t v = 0; v < sound.surface.vertices.size(); ++v) {
    if (tools::extreme_rays(stars.around(v)).empty()) continue;
    test::note("vertex", v);
    ++planted;
    Proven broken = sound;
    broken.stored.vertices[v] = wrong.vertices[v];
    CHECK(broken.proof().vertices.weak == std::vector<uint32_t>{v});
  }
  CHECK_GT(planted, 100u);
  planted = 0;
  for (uint32_t h = 0; h < 3 * sound.surface.faces.size(); h += 7) {
    test::note("half-edge", h);
    Proven broken = sound;
    int8_t& fold = broken.stored.edges[h / 3].fold[h % 3];
    if (fold == 0) continue;  // flat: either end of the codes is right
    fold = fold > 0 ? -127 : 127;
    ++planted;
    CHECK(broken.proof().edges.weak == std::vector<uint32_t>{h});
  }
  CHECK_GT(planted, 50u);
}

// The codes of 8 bits end so that a blade's edge keeps a margin on both of its sides.
TEST(BladeEdge_IsSignedDownTo7e4Rad) {
  for (const auto& [opening_rad, weak] : std::vector<std::pair<double, bool>>{
           {0.01, false}, {0.001, false}, {7e-4, false}, {6e-4, true}}) {
    test::note("opening in millionths", static_cast<int64_t>(opening_rad * 1e6));
    const float half_m = static_cast<float>(opening_rad / 2);
    tools::Surface blade;
    blade.vertices = {{0, -1, 0}, {0, 1, 0}, {1, 0, half_m}, {1, 0, -half_m}};
    blade.faces = {{1, 0, 2}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const Proven proven(std::move(blade));
    CHECK_EQ(!proven.proof().edges.weak.empty(), weak);
  }
}

// The corner c of a face lies, except for a rounding, on the edge a b of the next: float32 may take
// the sides of the sliver between them for one another.
// So may the triangles beside it, which measure its edges by themselves. Of a million points about
// such slivers one is allowed to be wrong: whose distances to both edges differ by just the height.
TEST(ASliverIsRefusedOrItsSideIsRight) {
  tools::Random random(9);
  const auto near = [&](Point p) {
    return tools::to_vec3(p + Point{random.bell(), random.bell(), random.bell()} * 0.2);
  };
  int refused = 0, baked = 0, compared = 0, wrong = 0;
  for (int i = 0; i < 24000; ++i) {
    test::note("case", i);
    tools::Surface surface;
    surface.vertices = {
        near({0, 0, 1}), near({1, 0, 1}), {}, near({0.5, 1, 0}), near({0.5, -1, 0})};
    const Point a = tools::to_point(surface.vertices[0]), b = tools::to_point(surface.vertices[1]);
    const double lift = std::pow(10.0, random.between(-9, -4));
    surface.vertices[2] = tools::to_vec3(a * 0.5 + b * 0.5 + Point{0, lift, lift});
    surface.faces = {{0, 2, 3}, {2, 1, 3}, {2, 0, 1}, {1, 0, 4}, {0, 3, 4}, {3, 1, 4}};
    if (!check_and_mend(surface, {}).usable() || surface.faces.size() != 6) continue;
    tools::MeshReport report;
    const auto sections = tools::bake_mesh(surface, "sliver", {}, report);
    if (!report.problem.empty()) {
      ++refused;
      CHECK(report.problem.find("thin") != std::string::npos ||
            report.problem.find("folds back") != std::string::npos);
      continue;
    }
    ++baked;
    mesh::View view;
    CHECK(tools::open_baked(sections, "sliver", view).ok());
    for (int k = 0; k < 60; ++k) {
      const Point along = a + (b - a) * random.uniform();
      const double reach = std::pow(10.0, random.between(-5, 0));
      const math::Vec3 p =
          tools::to_vec3(along + Point{random.bell(), random.bell(), random.bell()} * reach);
      mesh::Hint hint;
      const mesh::Closest c = mesh::closest_point(view, p, query::kUnlimited, hint);
      const mesh_test::Truth truth = mesh_test::brute_force(surface, mesh_test::wide(p));
      if (!(truth.distance > 2e-6 * double{view.head().diagonal_m}) || c.certificate.sign == 0)
        continue;
      ++compared;
      wrong += c.certificate.sign != (truth.inside ? -1 : 1) ? 1 : 0;
    }
  }
  CHECK_GT(compared, 1000000);
  CHECK_LE(wrong, compared / 1000000);
  CHECK_GT(refused, 600);
  CHECK_GT(baked, 12000);
}

// Two cubes through each other: sides differ at the vertices of the one inside the other.
TEST(CrossingSolids_DifferingFeatures_AreListedByPosition) {
  tools::Surface cubes = tools::cube();
  append(cubes, tools::cube({1.25f, 1.125f, 1}));
  tools::MeshReport report;
  (void)tools::bake_mesh(cubes, "cubes", {}, report);
  CHECK(report.problem.empty());
  CHECK_EQ(report.signs.crossings.places.size(), 1u);
  CHECK_EQ(report.signs.differing.size(), 2u);
  if (report.signs.differing.size() != 2) return;
  CHECK(report.signs.differing[0].vertices == (std::vector<uint32_t>{7, 8}));
  CHECK_EQ(report.signs.differing[1].count(), 0u);
  CHECK_GT(report.signs.compared, 40u);
  const std::vector<std::string> lines = describe(report.signs, cubes, {});
  CHECK(!lines.empty() && lines.back().find("at place 1") == 0 &&
        lines.back().find("2 vertices (7, 8)") != std::string::npos);
}

TEST(TheHorsesDifferingFeaturesAllLieAtItsOnePlace) {
  if (mesh_test::models_folder().empty())
    return test::skip("FIRMTOUCH_MODELS names no folder of real models");
  tools::Surface horse = mesh_test::real_model("horse.ply");
  tools::SignReport report;
  std::string problem;
  (void)tools::bake_signs(horse, 0, report, problem);
  CHECK(problem.empty());
  CHECK_EQ(report.differing.size(), 2u);
  if (report.differing.size() != 2) return;
  // The star of vertex 11891 crosses itself: the margin of any normal there is below zero.
  CHECK(report.differing[0].vertices == (std::vector<uint32_t>{11890, 11891}));
  CHECK_GT(report.differing[0].count(), 3u);
  CHECK_EQ(report.differing[1].count(), 0u);
  CHECK_GT(report.edge_margin_rad, tools::kMinMargin_rad);
}
