// Pairs of faces that may meet: none that does is missed, and fans and flat faces have few.
#include <initializer_list>

#include "shapes.hpp"
#include "surface/near_faces.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

using math::Vec3;

Vec3 mixed(Vec3 a, Vec3 b, float of_b) {
  return {a.x + (b.x - a.x) * of_b, a.y + (b.y - a.y) * of_b, a.z + (b.z - a.z) * of_b};
}

size_t pairs_of(const Surface& surface) {
  const NearFaces faces(surface);
  std::vector<uint32_t> near;
  size_t pairs = 0;
  for (uint32_t f = 0; f < surface.faces.size(); ++f) {
    faces.above(f, near);
    pairs += near.size();
  }
  return pairs;
}

// A ring of `count` vertices at each height.
std::vector<Vec3> rings(uint32_t count, std::initializer_list<float> heights) {
  std::vector<Vec3> vertices;
  for (const float z : heights) {
    for (uint32_t k = 0; k < count; ++k) {
      const double angle = k * 6.283185307179586 / count;
      vertices.push_back(
          {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z});
    }
  }
  return vertices;
}

// A prism whose caps are fans: about a corner of the rim, or about their middle.
Surface fan_prism(uint32_t count, bool about_middle) {
  std::vector<Vec3> vertices = rings(count, {0, 1});
  vertices.insert(vertices.end(), {{0, 0, 0}, {0, 0, 1}});
  std::vector<Face> faces;
  const uint32_t low = about_middle ? 2 * count : 0, high = about_middle ? low + 1 : count;
  for (uint32_t a = 0; a < count; ++a) {
    const uint32_t b = (a + 1) % count;
    faces.insert(faces.end(), {{a, b, count + b}, {a, count + b, count + a}});
    if (!about_middle && (a == 0 || b == 0)) continue;
    faces.insert(faces.end(), {{low, b, a}, {high, count + a, count + b}});
  }
  return numbered(vertices, faces);
}

// A sharp cone and a blunt one below it.
Surface two_cones(uint32_t count) {
  std::vector<Vec3> vertices = rings(count, {0});
  vertices.insert(vertices.end(), {{0, 0, 4}, {0, 0, -1}});
  std::vector<Face> faces;
  for (uint32_t a = 0; a < count; ++a) {
    const uint32_t b = (a + 1) % count;
    faces.insert(faces.end(), {{a, b, count}, {b, a, count + 1}});
  }
  return numbered(vertices, faces);
}

// A flat disc cut to and fro, askew to the axes.
Surface zigzag_disc(uint32_t count) {
  std::vector<Face> faces;
  const uint32_t first = count / 8;
  for (uint32_t k = 0; k + 2 < count; ++k) {
    const auto corner = [&](uint32_t i) {
      return (first + (i % 2 == 1 ? (i + 1) / 2 : count - i / 2)) % count;
    };
    faces.push_back({corner(k), corner(k + 1), corner(k + 2)});
  }
  return numbered(rings(count, {0}), faces);
}

Vec3 random_corner(Random& random) {
  const auto of = [&] { return static_cast<float>(random.below(5)); };
  return {of(), of(), of()};
}

}  // namespace

TEST(LongFacesThatMeetInVerticesAreFewPairs) {
  for (const bool about_middle : {false, true}) {
    const Surface prism = fan_prism(400, about_middle);
    CHECK(is_closed_and_alike(prism));
    CHECK_LT(pairs_of(prism), 4 * prism.faces.size());
  }
  CHECK(is_closed_and_alike(two_cones(400)));
  CHECK_LT(pairs_of(two_cones(400)), 4 * 800u);
  CHECK_LT(pairs_of(zigzag_disc(400)), 4 * 398u);
}

TEST(FacesWithACommonPointAreAPair) {
  Random random(11);
  for (int k = 0; k < 20000; ++k) {
    test::note("case", k);
    const Vec3 a = random_corner(random), b = random_corner(random), c = random_corner(random),
               d = random_corner(random);
    // Of abc: on an edge, within it or its corner, all without rounding.
    const Vec3 side = mixed(b, c, 0.5f * static_cast<float>(random.below(3)));
    const Vec3 spot = mixed(side, a, 0.25f * static_cast<float>(random.below(3)));
    // The other face has it as a corner or on an edge, and may begin at `a`, too.
    const bool is_end = random.below(2) == 0, has_common = random.below(2) == 0;
    const Vec3 e = is_end ? spot : mixed(d, spot, 2);
    if (has_common && !(length(to_point(spot) - to_point(a)) > 0)) continue;
    Surface pair =
        numbered({a, b, c, d, e, random_corner(random)}, {{0, 1, 2}, {has_common ? 0u : 5u, 3, 4}});
    CHECK_EQ(pairs_of(pair), 1u);
    if (!has_common || k % 8 != 0) continue;
    for (uint32_t v = 6; v < 156; v += 2) {  // among many about `a`
      pair.vertices.insert(pair.vertices.end(), {random_corner(random), random_corner(random)});
      pair.faces.push_back({0, v, v + 1});
    }
    std::vector<uint32_t> near;
    NearFaces(pair).above(0, near);
    CHECK_EQ(std::count(near.begin(), near.end(), 1u), 1);
  }
}

}  // namespace firmtouch::tools
