#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/random.hpp"

// --mend: what plain checking refuses becomes closed, or is refused by name.

namespace firmtouch::tools {
namespace {

CheckOptions mending() {
  CheckOptions options;
  options.mend = true;
  return options;
}

// Refused as it is, and closed when mended.
CheckReport mended(Surface& surface) {
  Surface plain = surface;
  const CheckReport refused = check_and_mend(plain, {});
  CHECK(!refused.usable());
  CHECK(says(refused.refused, "--mend"));
  const CheckReport report = check_and_mend(surface, mending());
  for (const std::string& line : report.refused) std::printf("      said: %s\n", line.c_str());
  CHECK(report.usable());
  CHECK(is_closed_and_alike(surface));
  return report;
}

}  // namespace

TEST(TwoSolidsAtOneVertex_GetVerticesOfTheirOwn) {
  Surface two = cube();
  append(two, cube({2, 2, 2}));
  for (Face& face : two.faces)
    for (uint32_t& v : face) v = v == 8 ? 7 : v;
  CHECK(says(mended(two).mended, "gave separate sheets vertices of their own at 1 vertex"));
  CHECK_LT(std::fabs(volume_of(two) - (16)), 1e-3);
  CHECK(find_crossings(two).pairs.empty());
}

TEST(TwoSolidsAtOneEdge_ArePartedAlongIt) {
  Surface two = cube();
  append(two, cube({2, 2, 0}));
  for (Face& face : two.faces)
    for (uint32_t& v : face) v = v == 8 ? 3 : v == 12 ? 7 : v;
  mended(two);
  CHECK_LT(std::fabs(volume_of(two) - (16)), 1e-3);
  CHECK(find_crossings(two).pairs.empty());
}

TEST(AFinAndAnInnerWall_AreRemoved) {
  Surface fin = cube();
  fin.vertices.push_back({1.2f, 1.2f, 0});
  fin.faces.push_back({3, 7, 8});
  fin.source.push_back(12);
  CHECK(says(mended(fin).mended, "removed 1 face of dangling sheets"));
  CHECK(same(fin, cube()));

  Surface wall = numbered(cube().vertices, cube().faces);
  wall.faces.push_back({0, 3, 7});  // the diagonal plane
  wall.faces.push_back({0, 7, 4});
  wall.source.push_back(12);
  wall.source.push_back(13);
  Surface copy = wall;
  const CheckReport report = check_and_mend(copy, mending());
  CHECK(!report.usable() || is_closed_and_alike(copy));  // a fifth of the area: too much to remove
}

TEST(CornersNearEachOther_AreWelded) {
  Random random(7);
  Surface soup;
  const Surface whole = cube();
  for (const Face& face : whole.faces)
    for (const uint32_t v : face) {
      const float by = static_cast<float>(random.between(-1e-5, 1e-5));
      {
        const math::Vec3 at = whole.vertices[v];
        soup.vertices.push_back({at.x + by, at.y - by, at.z + by});
      }
    }
  for (uint32_t f = 0; f < 12; ++f) soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  CHECK(says(mended(soup).mended, "welded"));
  CHECK_EQ(soup.vertices.size(), 8u);
}

TEST(AHoleAndAPieceWoundAgainstTheRest_AreMended) {
  Surface open = cube();
  open.faces.pop_back();
  open.source.pop_back();
  turn(open.faces[3]);
  mended(open);
  CHECK_LT(std::fabs(volume_of(open) - (8)), 1e-9);
}

TEST(WhatMendingCannotClose_IsRefusedWithWrap) {
  Surface sheet = numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const CheckReport report = check_and_mend(sheet, mending());
  CHECK(!report.usable());
  CHECK(says(report.refused, "--wrap"));
}

}  // namespace firmtouch::tools
