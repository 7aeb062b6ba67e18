#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/read/read_surface.hpp"

// --close-holes: what was open is closed, outward and does not cross itself, or is refused.

namespace firmtouch::tools {
namespace {

CheckReport close(Surface& surface) {
  CheckOptions options;
  options.close_holes = true;
  const CheckReport report = check_and_mend(surface, options);
  for (const std::string& line : report.refused) std::printf("  refused: %s\n", line.c_str());
  return report;
}

void drop(Surface& surface, const std::vector<uint32_t>& faces) {
  for (size_t k = faces.size(); k-- > 0;) {
    surface.faces.erase(surface.faces.begin() + faces[k]);
    surface.source.erase(surface.source.begin() + faces[k]);
  }
}

bool is_sound(const Surface& surface, const CheckReport& report) {
  return report.usable() && report.is_closed && is_closed_and_alike(surface) &&
         volume_of(surface) > 0;
}

// A bowl whose rim has `count` edges that go up and down, and a tip below.
Surface bowl(uint32_t count) {
  Surface surface;
  surface.vertices.push_back({0, 0, -1});
  for (uint32_t k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / count;
    surface.vertices.push_back({static_cast<float>(std::cos(angle)),
                                static_cast<float>(std::sin(angle)), k % 2 == 0 ? 0.1f : -0.1f});
    surface.faces.push_back({0, 1 + (k + 1) % count, 1 + k});
  }
  return numbered(surface.vertices, surface.faces);
}

}  // namespace

TEST(ACubeWithoutItsLidIsTheCubeAgain) {
  Surface surface = cube();
  const std::vector<Face> whole = surface.faces;
  drop(surface, {2, 3});
  const CheckReport report = close(surface);
  CHECK(is_sound(surface, report));
  CHECK(std::fabs(volume_of(surface) - 8) < 1e-12);
  CHECK_EQ(surface.faces.size(), 12u);
  CHECK(says(report.mended, "closed 1 hole with 2 triangles, numbered from 10 on"));
  CHECK(says(report.mended, "closed a hole of 4 edges about (0, 0, 1 m), 2.83 m across"));
  CHECK_EQ(surface.source[11], 11u);
}

TEST(WithoutTheOptionAHoleIsRefusedWithTheRemedy) {
  Surface surface = cube();
  drop(surface, {2, 3});
  CHECK(says(check_and_mend(surface, {}).refused, "--close-holes"));
}

TEST(ASoundSurfaceStaysAsItIs) {
  Surface surface = make_part(1, 2000);
  const Surface before = surface;
  const CheckReport report = close(surface);
  CHECK(report.mended.empty() && is_sound(surface, report) && same(surface, before));
}

TEST(HolesThatTouchAtACornerAreTwoHoles) {
  Surface surface = cube();
  drop(surface, {0, 3});  // faces 0 2 3 below and 4 7 6 above do not touch; 0 4 6 touches 0 2 3
  drop(surface, {7});
  const CheckReport report = close(surface);
  CHECK(is_sound(surface, report));
  CHECK(std::fabs(volume_of(surface) - 8) < 1e-12);
}

TEST(ARimThatGoesUpAndDownIsClosedWithoutAFold) {
  for (const uint32_t count : {6u, 7u, 40u, 101u}) {
    Surface surface = bowl(count);
    const CheckReport report = close(surface);
    test::note("edges of the rim", count);
    CHECK(is_sound(surface, report));
    CHECK_EQ(surface.faces.size(), 2 * count - 2);
    CHECK(find_crossings(surface).pairs.empty());
  }
}

TEST(ManyHolesOfARealShapeAreClosedWithAboutItsVolume) {
  const Surface whole = make_part(3, 4000);
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Surface surface = whole;
    Random random(seed);
    std::vector<bool> gone(surface.vertices.size(), false);
    for (int k = 0; k < 20; ++k) gone[random.below(static_cast<uint32_t>(gone.size()))] = true;
    std::vector<uint32_t> dropped;
    for (uint32_t f = 0; f < surface.faces.size(); ++f) {
      const Face& face = surface.faces[f];
      if (gone[face[0]] || gone[face[1]] || gone[face[2]]) dropped.push_back(f);
    }
    drop(surface, dropped);
    const CheckReport report = close(surface);
    CHECK(is_sound(surface, report));
    CHECK_LE(std::fabs(volume_of(surface) / volume_of(whole) - 1), 0.01);
    CHECK(find_crossings(surface).pairs.empty());
  }
}

TEST(AnOpenPieceWoundInsideOutIsTurnedAndClosed) {
  Surface surface = cube();
  for (Face& face : surface.faces) turn(face);
  drop(surface, {2, 3});
  const CheckReport report = close(surface);
  CHECK(is_sound(surface, report));
  CHECK(says(report.mended, "inside out"));
}

TEST(ALoneSheetCannotBecomeASolid) {
  Surface triangle = numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  CHECK(says(close(triangle).refused, "without folding back"));
  Surface square = numbered({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  CHECK(says(close(square).refused, "a hole of 4 edges about (0.5, 0.5, 0 m)"));
}

TEST(ACapThatWouldPassThroughTheSurfaceIsRefused) {
  Surface surface = cube();
  drop(surface, {2, 3});
  Surface spike = tetrahedron();  // stands in the cube and looks out of it
  for (math::Vec3& v : spike.vertices) v = {v.x * 0.2f, v.y * 0.2f, v.z * 1.5f};
  append(surface, spike);
  CHECK(says(close(surface).refused, "whose cap would pass through the surface"));
}

TEST(AHoleOfTooManyEdgesIsRefusedWithItsSize) {
  Surface surface = bowl(1001);
  CHECK(says(close(surface).refused, "has a hole of 1001 edges"));
}

TEST(TheBunnyIsClosed) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  Imported read = read_surface(std::string(folder) + "/stanford-bunny.obj", 1);
  CHECK(read.problem.empty());
  const CheckReport report = close(read.surface);
  CHECK(is_sound(read.surface, report));
  CHECK(says(report.mended, "closed 5 holes with 213 triangles, numbered from 69451 on"));
  CHECK(find_crossings(read.surface).pairs.empty());
  for (const std::string& line : report.mended) std::printf("  %s\n", line.c_str());
}

}  // namespace firmtouch::tools
