#include <cmath>
#include <cstring>

#include "closest_by_force.hpp"
#include "firmtouch/core/hash.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_part.hpp"
#include "surface/make/make_walk.hpp"
#include "surface/random.hpp"
#include "surface/turns.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::tools {
namespace {

void add(core::Hash& hash, float value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  hash.add(bits);
}

uint64_t hash_of(const std::vector<math::Vec3>& points) {
  core::Hash hash;
  for (const math::Vec3& p : points) add(hash, p.x), add(hash, p.y), add(hash, p.z);
  return hash.value();
}

double smallest_angle_rad(const Surface& surface) {
  double smallest = 4;
  for (const Face& f : surface.faces) {
    for (uint32_t k = 0; k < 3; ++k) {
      const Point a = to_point(surface.vertices[f[k]]),
                  b = to_point(surface.vertices[f[(k + 1) % 3]]) - a,
                  c = to_point(surface.vertices[f[(k + 2) % 3]]) - a;
      smallest = std::min(smallest, std::atan2(length(cross(b, c)), dot(b, c)));
    }
  }
  return smallest;
}

double diagonal_of(const Surface& surface) {
  Point low{9, 9, 9}, high{-9, -9, -9};
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

std::vector<math::Vec3> walk_on(const Surface& surface, uint64_t seed, uint32_t points) {
  return make_walk(surface, seed, points,
                   [&](math::Vec3 p) { return to_vec3(closest_by_force(surface, to_point(p))); });
}

}  // namespace

TEST(SineAndCosineOfTurnsAreAccurate) {
  Random random(1);
  for (int k = 0; k < 100000; ++k) {
    const double turns = k < 64 ? k / 16.0 - 2 : random.between(-3, 3);
    const double x = 2 * 3.14159265358979323846 * (turns - std::floor(turns + 0.5));
    CHECK_LE(std::fabs(sine_of_turns(turns) - std::sin(x)), 6e-16);
    CHECK_LE(std::fabs(cosine_of_turns(turns) - std::cos(x)), 6e-16);
  }
  CHECK_LE(std::fabs(sine_of_turns(0.5)), 0.0);
  CHECK_LE(std::fabs(cosine_of_turns(1000) - 1), 0.0);
}

TEST(PartsAreClosedOutwardAndOfGenusOne) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    for (const uint32_t faces : {2000u, 5000u, 20000u}) {
      const Surface part = make_part(seed, faces);
      CHECK_LE(faces, part.faces.size());
      CHECK_LE(part.faces.size(), faces + faces / 10);
      CHECK(is_closed_and_alike(part));
      CHECK_EQ(2 * part.vertices.size(), part.faces.size());  // V - E + F = 0 with E = 3 F / 2
      CHECK_LE(std::fabs(volume_of(part) - 95e-6), 20e-6);    // cubic metres
      CHECK_LE(std::fabs(diagonal_of(part) - 0.137), 0.01);
      CHECK_LE(faces == 2000 ? 0.08 : 0.2, smallest_angle_rad(part));
    }
  }
}

TEST(PartsPassTheCheckUntouchedAndDoNotCrossThemselves) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Surface part = make_part(seed, seed % 2 == 0 ? 5000 : 20000);
    const Surface before = part;
    const CheckReport report = check_and_mend(part, {});
    CHECK(report.usable() && report.is_closed && report.mended.empty() && same(part, before));
    CHECK(find_crossings(part).pairs.empty());
  }
}

TEST(PathsRunInTheGrooveUnevenlyAndClose) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Surface part = make_part(seed);
    const std::vector<math::Vec3> path = make_path(seed);
    CHECK_EQ(path.size(), 2000u);
    const Point gap = to_point(path.back()) - to_point(path.front());
    CHECK_LE(length(gap), 0.0);
    double shortest = 1, longest = 0;
    for (size_t k = 1; k < path.size(); ++k) {
      const double step = length(to_point(path[k]) - to_point(path[k - 1]));
      shortest = std::min(shortest, step);
      longest = std::max(longest, step);
    }
    CHECK_LT(0, shortest);
    CHECK_LE(2 * shortest, longest);
    CHECK_LE(longest, 0.0005);
    for (size_t k = 0; k < path.size(); k += 40) {
      const Point p = to_point(path[k]);
      const double height = length(closest_by_force(part, p) - p);
      CHECK_LE(0.0024, height);  // the groove's walls are a little nearer than its floor
      CHECK_LE(height, kGuideHeight_m + 1e-4);
      CHECK_LE(std::fabs(winding_by_angles(part, p)), 1e-6);  // in the open
    }
  }
}

TEST(WalksStepEvenlyAndStayNearTheSurface) {
  const Surface part = make_part(4, 2000);
  const double diagonal = diagonal_of(part);
  const std::vector<math::Vec3> walk = walk_on(part, 1, 4000);
  CHECK_EQ(walk.size(), 4000u);
  uint32_t inside = 0;
  double sum = 0;
  for (size_t k = 0; k < walk.size(); ++k) {
    const Point p = to_point(walk[k]);
    if (k > 0) CHECK_LE(std::fabs(length(p - to_point(walk[k - 1])) / diagonal - 0.0005), 1e-6);
    const double distance = length(closest_by_force(part, p) - p);
    CHECK_LE(distance, 0.02 * diagonal);
    sum += distance;
    if (k % 20 == 0 && winding_by_angles(part, p) > 0.5) ++inside;
  }
  CHECK_LE(20, inside);  // both sides are visited
  CHECK_LE(inside, 180);
  const double mean = sum / 4000 / diagonal;
  CHECK_LE(0.0003, mean);  // it leaves the surface,
  CHECK_LE(mean, 0.002);   // and touches it
}

TEST(AWalkThatIsFarFromTheSurfaceGoesStraightBack) {
  const math::Vec3 far{3, 4, 5};  // what the closest point is said to be
  const Surface body = cube();
  const std::vector<math::Vec3> walk = make_walk(body, 1, 500, [&](math::Vec3) { return far; });
  for (size_t k = 1; k < walk.size(); ++k) {
    const double before = length(to_point(far) - to_point(walk[k - 1]));
    const double after = length(to_point(far) - to_point(walk[k]));
    CHECK_LE(std::fabs(before - after - 0.0005 * diagonal_of(body)), 1e-6);
  }
}

TEST(SeedsDifferAndRepeat) {
  CHECK(same(make_part(1, 2000), make_part(1, 2000)));
  CHECK(!same(make_part(1, 2000), make_part(2, 2000)));
  CHECK(hash_of(make_path(1)) != hash_of(make_path(2)));
  CHECK(hash_of(walk_on(cube(), 1, 50)) != hash_of(walk_on(cube(), 2, 50)));
}

// The same bytes on every machine: these hashes were seen from gcc and clang, -O0 to -O3, on
// x86-64.
TEST(GeneratedBytesAreTheSameEverywhere) {
  CHECK(hash_of(make_part(1).vertices) == 0x7DB6C8DED09D0EE7ull);
  CHECK(hash_of(make_path(1)) == 0x8ABDF86C9B91070Cull);
  CHECK(hash_of(walk_on(cube(), 1, 2000)) == 0xE3372C0730C62C28ull);
}

TEST(PointsAreWrittenWithNineDigits) {
  CHECK(to_csv({{0.1f, -2, 1e-9f}, {1234567.875f, 0, 3}}) ==
        "x,y,z\n0.100000001,-2,9.99999972e-10\n1234567.88,0,3\n");
}

}  // namespace firmtouch::tools
