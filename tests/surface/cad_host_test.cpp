// Generated machined parts: closed and sound, with the long thin triangles of CAD exports.
#include <algorithm>

#include "firmtouch/core/hash.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/ear_clip.hpp"
#include "surface/make/make_cad.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint64_t kSeeds = 20;

Surface surface_of(const CadPart& part) {
  std::vector<math::Vec3> vertices;
  for (const Point& v : part.vertices_mm) vertices.push_back(to_vec3(v));
  return numbered(vertices, part.faces);
}

double longest_share(const Surface& surface) {  // longest edge, of the diagonal
  Point low = to_point(surface.vertices[0]), high = low;
  double longest = 0;
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (const Face& f : surface.faces)
    for (uint32_t k = 0; k < 3; ++k)
      longest = std::max(longest, length(to_point(surface.vertices[f[k]]) -
                                         to_point(surface.vertices[f[(k + 1) % 3]])));
  return longest / length(high - low);
}

int64_t area2(const std::vector<DrawingPoint>& points, const Face& f) {
  const DrawingPoint &a = points[f[0]], &b = points[f[1]], &c = points[f[2]];
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int64_t area2(const Outline& loop) {
  int64_t sum = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    const DrawingPoint &a = loop[k], &b = loop[(k + 1) % loop.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

}  // namespace

TEST(CadParts_AreClosedAndSound) {
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Surface part = surface_of(make_cad(seed));
    CHECK(is_closed_and_alike(part));
    CHECK_LT(0, volume_of(part));
    const Surface before = part;
    const CheckReport report = check_and_mend(part, {});
    CHECK(report.usable() && report.is_closed && report.mended.empty() && same(part, before));
    CHECK(find_crossings(part).pairs.empty());
  }
}

TEST(CadParts_EachTriangleWithOwnVertices_AreWelded) {
  for (uint64_t seed = 0; seed < kCadKinds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Surface part = surface_of(make_cad(seed));
    Surface soup;
    for (const Face& face : part.faces) {
      const uint32_t first = static_cast<uint32_t>(soup.vertices.size());
      for (const uint32_t v : face) soup.vertices.push_back(part.vertices[v]);
      soup.faces.push_back({first, first + 1, first + 2});
    }
    const CheckReport report = check_and_mend(soup, {});
    CHECK(report.usable() && report.is_closed);
    CHECK_EQ(soup.vertices.size(), part.vertices.size());
  }
}

TEST(CadParts_HaveLongThinTriangles) {
  double least = 1;
  for (uint64_t seed = 0; seed < kSeeds; ++seed)
    least = std::min(least, longest_share(surface_of(make_cad(seed))));
  CHECK_LE(0.2, least);
}

TEST(CadParts_HaveFewDecimalsAndStandingSeeds) {
  core::Hash hash;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const CadPart part = make_cad(seed);
    CHECK_EQ(part.decimals, seed / kCadKinds % 2 == 1 ? 6 : 3);
    const std::string text = to_obj(part);
    for (const char c : text) hash.add(static_cast<uint8_t>(c));
    const size_t point = text.find('.');
    CHECK_EQ(text.find_first_not_of("0123456789", point + 1) - point - 1,
             static_cast<size_t>(part.decimals));
  }
  CHECK_EQ(hash.value(), 5841076559696552286u);
}

TEST(EarClipping_FillsExactlyTheArea) {
  const Outline square{{0, 0}, {9000, 0}, {9000, 9000}, {0, 9000}};
  const std::vector<Outline> loops{square,
                                   {{1000, 1000}, {1000, 3000}, {3000, 1000}},
                                   {{5000, 5000}, {5000, 8000}, {8000, 8000}, {8000, 5000}},
                                   {{1000, 6000}, {2000, 8000}, {3000, 6000}}};
  std::vector<DrawingPoint> points;
  int64_t expected = 0, sum = 0;
  for (const Outline& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    expected += area2(loop);
  }
  const std::vector<Face> faces = clip_ears(loops);
  CHECK_EQ(faces.size(), points.size() + 2 * 3 - 2);
  for (const Face& f : faces) {
    CHECK_LT(0, area2(points, f));
    sum += area2(points, f);
  }
  CHECK_EQ(sum, expected);
}

TEST(EarClipping_RejectsWhatIsNoArea) {
  CHECK(clip_ears({}).empty());
  CHECK(clip_ears({{{0, 0}, {1000, 0}}}).empty());
  CHECK(clip_ears({{{0, 0}, {0, 1000}, {1000, 1000}, {1000, 0}}}).empty());  // clockwise
  const Outline square{{0, 0}, {9000, 0}, {9000, 9000}, {0, 9000}};
  CHECK(
      clip_ears({square, {{10000, 1000}, {10000, 2000}, {11000, 1000}}}).empty());  // hole outside
}

}  // namespace firmtouch::tools
