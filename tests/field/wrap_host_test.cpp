#include "field/wrap.hpp"

#include <algorithm>
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "field/foot.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/long.hpp"
#include "mesh/baked_mesh.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/random.hpp"
#include "surface/shapes.hpp"

// Wrapping: closed, manifold, around every point, at its distance; checked against solid angles and
// brute force. Then 200 bad models after one command.

namespace firmtouch::tools {
namespace {

double distance_to(const Surface& soup, Point p) {
  double least = 1e300;
  for (const Face& face : soup.faces)
    least = std::min(least,
                     foot_on(p, {to_point(soup.vertices[face[0]]), to_point(soup.vertices[face[1]]),
                                 to_point(soup.vertices[face[2]])})
                         .distance2);
  return std::sqrt(least);
}

Point spot_on(const Surface& surface, uint32_t f, Random& random) {
  const Face& face = surface.faces[f];
  const double u = random.uniform(), v = random.uniform() * (1 - u);
  return to_point(surface.vertices[face[0]]) * (1 - u - v) +
         to_point(surface.vertices[face[1]]) * u + to_point(surface.vertices[face[2]]) * v;
}

// What a wrapping promises, at random places.
void check_wrapped(const Surface& soup, double distance_m, uint64_t seed) {
  test::note("seed", static_cast<int64_t>(seed));
  WrapReport report;
  const Surface wrapped = wrap_surface(soup, distance_m, report);
  CHECK(report.problem.empty());
  CHECK(is_closed_and_alike(wrapped));
  CHECK(find_crossings(wrapped).pairs.empty());
  Random random(seed);
  const uint32_t faces = static_cast<uint32_t>(soup.faces.size());
  for (uint32_t k = 0; k < 40; ++k)
    CHECK_GT(winding_by_angles(wrapped, spot_on(soup, random.below(faces), random)), 0.5);
  for (uint32_t k = 0; k < 40; ++k) {
    const uint32_t v = random.below(static_cast<uint32_t>(wrapped.vertices.size()));
    const double d = distance_to(soup, to_point(wrapped.vertices[v]));
    CHECK_GT(d, 0.94 * distance_m);
    CHECK_LT(d, 1.06 * distance_m);
  }
}

Surface random_soup(uint64_t seed, uint32_t triangles) {
  Random random(seed);
  Surface soup;
  for (uint32_t f = 0; f < triangles; ++f) {
    const Point at{random.uniform(), random.uniform(), random.uniform()};
    for (uint32_t k = 0; k < 3; ++k)
      soup.vertices.push_back(to_vec3(
          at + Point{random.between(-.3, .3), random.between(-.3, .3), random.between(-.3, .3)}));
    soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return numbered(soup.vertices, soup.faces);
}

Surface points_of(const Surface& surface) {
  std::vector<Face> faces;
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) faces.push_back({v, v, v});
  return numbered(surface.vertices, faces);
}

// One of eight ways to spoil a machined part.
Surface bad_model(uint64_t seed) {
  Random random(seed);
  const CadPart part = make_cad(seed);
  Surface s;
  for (const Point& p : part.vertices_mm) s.vertices.push_back(to_vec3(p * 1e-3));
  s.faces = part.faces;
  const uint32_t faces = static_cast<uint32_t>(s.faces.size());
  const auto drop = [&](uint32_t count) {
    for (; count > 0; --count)
      s.faces.erase(s.faces.begin() + random.below(static_cast<uint32_t>(s.faces.size())));
  };
  switch (seed % 8) {
    case 0:
      drop(1 + random.below(4));
      break;  // holes
    case 1:
      drop(faces / 2);
      break;   // half of it is missing
    case 2:    // a soup: each face with corners of its own
    case 3: {  // and not quite at the same place
      Surface soup;
      const double by = seed % 8 == 2 ? 0 : 1e-7;
      for (uint32_t f = 0; f < faces; ++f) {
        for (const uint32_t v : s.faces[f])
          soup.vertices.push_back(
              to_vec3(to_point(s.vertices[v]) +
                      Point{random.between(-by, by), random.between(-by, by), 0}));
        soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
      }
      s = soup;
      break;
    }
    case 4: {  // two that share a vertex
      Surface other = s;
      const Point shift = to_point(s.vertices[0]) - to_point(s.vertices[s.vertices.size() / 2]);
      for (math::Vec3& v : other.vertices) v = to_vec3(to_point(v) + shift);
      const uint32_t first = static_cast<uint32_t>(s.vertices.size());
      append(s, other);
      for (Face& face : s.faces)
        for (uint32_t& v : face) v = v == first + first / 2 ? 0 : v;
      break;
    }
    case 5: {  // two through each other, the second in inches
      Surface other = s;
      for (math::Vec3& v : other.vertices)
        v = to_vec3(to_point(v) * (1 / 2.54) + Point{1e-3, 1.7e-3, 0.9e-3});
      append(s, other);
      break;
    }
    case 6:  // y up, some faces turned, a fin
      for (math::Vec3& v : s.vertices) v = {v.x, -v.z, v.y};
      for (uint32_t k = 0; k < 9; ++k) turn(s.faces[random.below(faces)]);
      s.vertices.push_back(to_vec3(to_point(s.vertices[0]) + Point{5e-3, 3e-3, 2e-3}));
      s.faces.push_back(
          {s.faces[0][0], s.faces[0][1], static_cast<uint32_t>(s.vertices.size()) - 1});
      break;
    default:
      s = random_soup(seed, 1 + random.below(40));
      break;
  }
  s.source.clear();
  return s;
}

}  // namespace

TEST(Wrapped_SoupsSheetsAndPoints_AreClosedAndEnclosed) {
  for (uint64_t seed = 1; seed <= 6; ++seed) check_wrapped(random_soup(seed, 12), 0.06, seed);
  check_wrapped(numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), 0.05, 1);
  check_wrapped(points_of(random_soup(9, 30)), 0.1, 1);
  Surface crossing = cube();
  append(crossing, cube({0.5f, 0.6f, 0.7f}));
  check_wrapped(crossing, 0.1, 1);
}

// Half of the places are within a thousandth of its size of the surface.
TEST(SidesOfAWrapping_AreThoseOfTheWindingNumber) {
  WrapReport report;
  const mesh_test::BakedMesh baked(wrap_surface(random_soup(5, 12), 0.12, report));
  CHECK(report.problem.empty());
  const Surface& surface = baked.surface;
  Random random(1);
  uint32_t wrong = 0, inside = 0;
  const uint32_t count = test::is_long() ? 100000 : 1000;
  for (uint32_t k = 0; k < count; ++k) {
    const double reach = (k % 2 == 0 ? 1e-3 : 0.2) * baked.size;
    const uint32_t f = random.below(static_cast<uint32_t>(surface.faces.size()));
    const math::Vec3 p = to_vec3(spot_on(surface, f, random) +
                                 Point{random.between(-reach, reach), random.between(-reach, reach),
                                       random.between(-reach, reach)});
    mesh::Hint hint;
    const mesh::Closest found = mesh::closest_point(baked.view, p, {}, hint);
    if (std::fabs(static_cast<double>(found.distance_m)) < 4e-7 * baked.size) continue;
    const bool is_inside = winding_by_angles(surface, to_point(p)) > 0.5;
    inside += is_inside ? 1u : 0u;
    wrong += found.certificate.sign != (is_inside ? -1 : 1) ? 1u : 0u;
  }
  std::printf("      %u of %u sides wrong, %u places inside\n", wrong, count, inside);
  CHECK_EQ(wrong, 0u);
  CHECK_GT(inside, count / 4);
}

TEST(AClosedHollow_IsFilled_AndOnePieceRemains) {
  WrapReport report;
  const Surface wrapped = wrap_surface(cube(), 0.2, report);
  CHECK_GT(report.voids, 0u);
  CHECK_GT(volume_of(wrapped), 8.0);
  CHECK_LT(volume_of(wrapped), 2.4 * 2.4 * 2.4);
}

TEST(AGridTooFine_IsRefusedWithADistanceThatServes) {
  WrapReport report;
  wrap_surface(cube(), 1e-4, report);
  CHECK(says(report.problem, "choose at least"));
}

TEST(TooManyTriangles_AreRefusedWithADistanceThatServes) {
  WrapReport report;
  const size_t count = wrap_surface(cube(), 0.1, report).faces.size();
  CHECK(wrap_surface(cube(), 0.1, report, count - 1).faces.empty());
  CHECK(says(report.problem, std::to_string(count) + " triangles"));
  CHECK(says(report.problem, "choose at least 0.11 m"));
  CHECK_LT(wrap_surface(cube(), 0.11, report, count - 1).faces.size(), count);
  CHECK(report.problem.empty());
}

TEST(BadModels_AreTouchableAfterOneCommand) {
  const uint32_t count = std::getenv("FIRMTOUCH_LONG") != nullptr ? 200 : 8;
  uint32_t mended = 0, wrapped = 0;
  for (uint64_t seed = 1; seed <= count; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Surface bad = bad_model(seed);
    Surface surface = bad;
    CheckOptions mending;
    mending.mend = true;
    bool is_good = check_and_mend(surface, mending).usable();
    mended += is_good ? 1u : 0u;
    if (!is_good) {
      Point low = to_point(bad.vertices[0]), high = low;
      for (const math::Vec3& v : bad.vertices) {
        const Point p = to_point(v);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
      WrapReport report;
      surface = wrap_surface(bad, 0.04 * length(high - low), report);
      is_good = report.problem.empty() && check_and_mend(surface, {}).usable();
      wrapped += is_good ? 1u : 0u;
    }
    CHECK(is_good);
    if (!is_good) continue;
    CHECK(is_closed_and_alike(surface));
    MeshReport report;
    const MeshOptions options;
    bake_mesh(surface, "bad", options, report);
    if (!report.problem.empty()) std::printf("      said: %s\n", report.problem.c_str());
    CHECK(report.problem.empty());
  }
  std::printf("      of %u bad models %u mended, %u wrapped\n", count, mended, wrapped);
  CHECK_GE(mended, count / 4);
}

}  // namespace firmtouch::tools
