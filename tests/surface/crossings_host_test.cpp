#include <set>

#include "shapes.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/winding_number.hpp"

namespace firmtouch::tools {
namespace {

// Whether the segment from p to q hits the triangle, by solving for the hit in extended precision.
bool hits(Point p, Point q, Point a, Point b, Point c) {
  using Real = long double;
  const auto wide = [](Point from, Point to, Real* v) {
    v[0] = static_cast<Real>(to.x) - static_cast<Real>(from.x);
    v[1] = static_cast<Real>(to.y) - static_cast<Real>(from.y);
    v[2] = static_cast<Real>(to.z) - static_cast<Real>(from.z);
  };
  const auto det = [](const Real* u, const Real* v, const Real* w) {
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
  };
  Real d[3], e[3], f[3], r[3];
  wide(q, p, d);  // p + t (q - p) = a + u e + v f   =>   u e + v f + t (p - q) = p - a
  wide(a, b, e);
  wide(a, c, f);
  wide(a, p, r);
  const Real all = det(e, f, d);
  if (!(all > 0 || all < 0)) return false;
  const Real u = det(r, f, d) / all, v = det(e, r, d) / all, t = det(e, f, r) / all;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

Box box_of(Point a, Point b, Point c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), 0},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), 0}};
}

// Pairs of faces without a common vertex that cross.
std::vector<std::pair<uint32_t, uint32_t>> pairs_by_force(const Surface& s) {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  const auto at = [&](uint32_t f, uint32_t k) { return to_point(s.vertices[s.faces[f][k % 3]]); };
  for (uint32_t f = 0; f < s.faces.size(); ++f) {
    for (uint32_t g = f + 1; g < s.faces.size(); ++g) {
      bool crosses = false, is_apart = false;
      for (uint32_t k = 0; k < 9; ++k)
        is_apart = is_apart || s.faces[f][k / 3] == s.faces[g][k % 3];
      const Box a = box_of(at(f, 0), at(f, 1), at(f, 2)), b = box_of(at(g, 0), at(g, 1), at(g, 2));
      is_apart = is_apart || a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y ||
                 b.low.y > a.high.y;
      if (is_apart) continue;
      for (uint32_t k = 0; k < 3; ++k) {
        crosses = crosses || hits(at(f, k), at(f, k + 1), at(g, 0), at(g, 1), at(g, 2)) ||
                  hits(at(g, k), at(g, k + 1), at(f, 0), at(f, 1), at(f, 2));
      }
      if (crosses) pairs.push_back({f, g});
    }
  }
  return pairs;
}

}  // namespace

TEST(CrossingPairsAreThoseOfBruteForce) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Random random(seed);
    Surface soup;
    for (uint32_t k = 0; k < 300; ++k) {
      soup.vertices.push_back({static_cast<float>(random.uniform()),
                               static_cast<float>(random.uniform()),
                               static_cast<float>(random.uniform())});
      if (k % 3 == 2) soup.faces.push_back({k - 2, k - 1, k});
    }
    soup.vertices[299] = soup.vertices[0];
    // Soup does not close: only the pairs matter here, the signs mean nothing.
    const Crossings found = find_crossings(soup);
    CHECK(found.pairs == pairs_by_force(soup));
    CHECK_LT(100, found.pairs.size());
  }
}

TEST(SurfacesThatTouchDoNotCross) {
  Surface stack = cube();
  append(stack, cube({0, 2, 2}));     // edge to edge
  append(stack, cube({-2, -2, -2}));  // corner to corner
  append(stack, numbered({{3, 0, 0}, {1, 0.5f, 0}, {1, -0.5f, 0.25f}, {3, 0, 1}},
                         {{0, 2, 1}, {0, 3, 2}, {1, 2, 3}, {0, 1, 3}}));  // edge on face
  const Crossings found = find_crossings(stack);
  CHECK(found.pairs.empty());
  CHECK(found.places.empty());
}

TEST(BodiesThatCrossOnlyAtDiagonalsAreFound) {
  Surface two = cube();
  append(two,
         cube({1, 1, 1}));  // every edge that enters the other does so on the diagonal of a face
  const Crossings found = find_crossings(two);
  CHECK_EQ(found.places.size(), 1u);
  CHECK_LE(12, found.pairs.size());
  CHECK(found.places.size() == 1 && found.places[0].vertices == (std::vector<uint32_t>{7, 8}));
}

// Edges that lie in the plane of another body's face cross its edges, or begin on them.
TEST(BodiesThatCrossInCommonPlanesAreFound) {
  for (const math::Vec3 shift : {math::Vec3{1, 1, 0}, math::Vec3{0.5f, 0.25f, 0}}) {
    Surface two = cube();
    append(two, cube(shift));
    const Crossings found = find_crossings(two);
    CHECK(found.pairs == pairs_by_force(two));
    CHECK_LT(5, found.pairs.size());
  }
}

TEST(FeaturesInsideAnotherSheetAreListed) {
  Surface two = make_part(1, 2000), other = make_part(2, 2000);
  const Surface first = two;
  for (math::Vec3& v : other.vertices) v = {v.x + 0.013f, v.y + 0.007f, v.z + 0.004f};
  append(two, other);
  const Crossings found = find_crossings(two);
  CHECK(found.pairs == pairs_by_force(two));
  std::set<uint32_t> listed;
  for (const Crossings::Place& place : found.places)
    listed.insert(place.vertices.begin(), place.vertices.end());
  const uint32_t split = static_cast<uint32_t>(first.vertices.size());
  uint32_t inside = 0;
  for (uint32_t v = 0; v < two.vertices.size(); ++v) {
    const bool is_inside =
        winding_by_angles(v < split ? other : first, to_point(two.vertices[v])) > 0.5;
    CHECK_EQ(listed.count(v) == 1, is_inside);
    inside += is_inside ? 1u : 0u;
  }
  CHECK_LT(300, inside);
}

TEST(PlacesAreListedApart) {
  Surface bodies;
  for (int k = 0; k < 3; ++k) {
    append(bodies, cube({10.0f * static_cast<float>(k), 0, 0}));
    append(bodies, cube({10.0f * static_cast<float>(k) + 1, 1.25f, 0.75f}));
  }
  const Crossings found = find_crossings(bodies);
  CHECK_EQ(found.places.size(), 3u);
  std::vector<uint32_t> source(bodies.vertices.size());
  for (uint32_t v = 0; v < source.size(); ++v) source[v] = 1000 + v;
  const std::vector<std::string> lines = describe(found, bodies, source);
  CHECK_EQ(lines.size(), 4u);
  CHECK(says(lines[0], "pairs of faces"));
  CHECK(says(lines[2], "place 2 of 3") && says(lines[2], "vertices 1023, 1024"));
}

TEST(AVertexPushedThroughTheOtherSideIsListed) {
  Surface surface = make_part(1, 2000);
  // The lowest vertex of the upper face above the foot is pulled through the foot.
  uint32_t pulled = 0;
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    const math::Vec3 p = surface.vertices[v];
    const float r2 = p.x * p.x + p.y * p.y;
    if (r2 > 0.0009f && r2 < 0.0015f && p.z > 0.005f && p.z < surface.vertices[pulled].z + 1 &&
        pulled == 0)
      pulled = v;
  }
  surface.vertices[pulled].z = -0.001f;
  const Crossings found = find_crossings(surface);
  CHECK_EQ(found.places.size(), 1u);
  const std::vector<uint32_t>& vertices =
      found.places.empty() ? std::vector<uint32_t>{} : found.places[0].vertices;
  CHECK(std::count(vertices.begin(), vertices.end(), pulled) == 1);
}

TEST(WindingNumberEqualsTheSolidAngle) {
  Surface shells = make_part(1, 2000);
  append(shells, cube({0.03f, 0, 0.005f}, 0.004f));
  Surface inward = cube({0.03f, 0, 0.005f}, 0.003f);
  for (Face& face : inward.faces) turn(face);
  append(shells, inward);
  const WindingNumber winding(shells, {});
  Random random(7);
  int seen[3] = {0, 0, 0};
  for (int k = 0; k < 2000; ++k) {
    test::note("point", k);
    const bool is_near = k % 2 == 0;
    const Point p = is_near ? Point{random.between(0.024, 0.036), random.between(-0.006, 0.006),
                                    random.between(0, 0.01)}
                            : Point{random.between(-0.06, 0.06), random.between(-0.06, 0.06),
                                    random.between(-0.01, 0.03)};
    const int wanted = static_cast<int>(std::lround(winding_by_angles(shells, p)));
    CHECK_EQ(winding.at(p), wanted);
    if (wanted >= 0 && wanted <= 2) ++seen[wanted];
  }
  CHECK_LT(100, seen[0]);
  CHECK_LT(100, seen[1]);
  CHECK_LT(100, seen[2]);
}

TEST(RaysThroughEdgesAndVerticesCountOnce) {
  // The ray's direction is the source's: the points lie below corners, edges and diagonals, up to
  // rounding either way.
  const Surface body = cube();
  const WindingNumber winding(body, {});
  for (double x = -0.75; x < 1; x += 0.25) {
    for (double y = -0.75; y < 1; y += 0.25) {
      for (double z = -0.75; z < 1; z += 0.25) {
        CHECK_EQ(winding.at({x, y, z}), 1);
        CHECK_EQ(winding.at({x + 0.0739177 * (z - 3), y + 0.1270433 * (z - 3), -3 + z}), 0);
      }
    }
  }
  for (const math::Vec3& v : body.vertices) {
    const Point corner = to_point(v);
    const Point below = corner - Point{0.0739177, 0.1270433, 1} * (corner.z > 0 ? 3.0 : 1.0);
    CHECK_EQ(winding.at(below), 0);
  }
}

}  // namespace firmtouch::tools
