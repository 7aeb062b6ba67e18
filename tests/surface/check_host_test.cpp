#include "harness/long.hpp"
#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

// One planted defect a test: mended without a trace but the report, or refused with its place.

namespace firmtouch::tools {
namespace {

// Every triangle with vertices of its own.
Surface torn(const Surface& whole) {
  Surface soup;
  for (const Face& face : whole.faces) {
    const uint32_t first = static_cast<uint32_t>(soup.vertices.size());
    for (const uint32_t v : face) soup.vertices.push_back(whole.vertices[v]);
    soup.source.push_back(static_cast<uint32_t>(soup.faces.size()));
    soup.faces.push_back({first, first + 1, first + 2});
  }
  return soup;
}

bool passes(Surface surface) {
  const Surface before = surface;
  const CheckReport report = check_and_mend(surface, {});
  return report.usable() && report.is_closed && report.mended.empty() && same(surface, before);
}

// Whether the surface is refused with these words, and kept with them under --unsigned.
bool is_refused(const Surface& surface, const char* what, const char* where) {
  Surface strict = surface, loose = surface;
  const CheckReport report = check_and_mend(strict, {}), kept = check_and_mend(loose, {true});
  bool found = false;
  for (const std::string& line : report.refused)
    found = found || (says(line, what) && says(line, where));
  if (!found) {
    for (const std::string& line : report.refused) std::printf("  got: %s\n", line.c_str());
  }
  return found && says(report.refused, "--unsigned") && kept.usable() && says(kept.kept, what) &&
         !kept.is_closed && loose.faces.size() == surface.faces.size();
}

bool is_always_refused(const Surface& surface, const char* what) {
  Surface strict = surface, loose = surface;
  return says(check_and_mend(strict, {}).refused, what) &&
         says(check_and_mend(loose, {true}).refused, what);
}

bool is_mended(Surface& surface, const char* how) {
  const CheckReport report = check_and_mend(surface, {});
  for (const std::string& line : report.refused) std::printf("  refused: %s\n", line.c_str());
  const bool good = report.usable() && report.is_closed && says(report.mended, how) &&
                    is_closed_and_alike(surface);
  if (!good) {
    for (const std::string& line : report.mended) std::printf("  mended: %s\n", line.c_str());
  }
  return good;
}

bool near(double a, double b) { return std::fabs(a - b) < 1e-9; }

}  // namespace

TEST(SoundSurfacesPassUntouched) {
  CHECK(passes(tetrahedron()));
  CHECK(passes(cube()));
  CHECK(passes(make_part(1, 2000)));
}

TEST(UnusedVerticesAreDropped) {
  Surface surface = cube();
  surface.vertices.insert(surface.vertices.begin() + 3, {{9, 9, 9}, {8, 8, 8}});
  for (Face& face : surface.faces) {
    for (uint32_t& v : face) v += v >= 3 ? 2u : 0u;
  }
  const CheckReport report = check_and_mend(surface, {});
  CHECK(report.usable() && same(surface, cube()));
  CHECK(says(report.mended, "dropped 2 vertices that no face uses, first vertex 3"));
  CHECK(report.vertex_source == (std::vector<uint32_t>{0, 1, 2, 5, 6, 7, 8, 9}));
}

TEST(TornVerticesAreWeldedWhereThatCloses) {
  Surface soup = torn(cube({1, 1, 1}));
  for (size_t v = 0; v < soup.vertices.size(); ++v) {  // -0 is 0
    math::Vec3& p = soup.vertices[v];
    if (v / 3 % 2 == 0) p = {p.x > 0 ? p.x : -0.0f, p.y > 0 ? p.y : -0.0f, p.z > 0 ? p.z : -0.0f};
  }
  CHECK(is_mended(soup, "welded 28 vertices"));
  CHECK_EQ(soup.vertices.size(), 8u);
  CHECK(near(volume_of(soup), 8));
}

TEST(BodiesThatTouchAtACornerAreNotWeldedTogether) {
  Surface two = cube();
  append(two, cube({2, 2, 2}));
  CHECK(passes(two));  // closed already: nothing to weld
  Surface soup = torn(two);
  CHECK(is_mended(soup, "welded"));
  CHECK_EQ(soup.vertices.size(), 16u);
  CHECK(near(volume_of(soup), 16));
}

TEST(FacesThatNameAVertexTwiceAreDropped) {
  Surface surface = cube();
  surface.faces.insert(surface.faces.begin() + 5, {2, 2, 7});
  surface.source.clear();
  CHECK(is_mended(surface, "dropped 1 face that names a vertex twice, first face 5"));
  CHECK(surface.faces == cube().faces);
}

TEST(DuplicateFacesAreDropped) {
  Surface surface = cube();
  surface.faces.push_back({7, 5, 4});  // face 2, from another corner
  surface.faces.push_back({3, 2, 0});  // face 0, turned
  surface.source.clear();
  CHECK(is_mended(surface, "dropped 2 faces that repeat others, first face 12"));
  CHECK(surface.faces == cube().faces);
}

TEST(AFinOfTwoSheetsIsDropped) {
  // Two pyramids base to base, and the base between them twice, back to back.
  const Surface body =
      numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3f, 0.3f, 1}, {0.3f, 0.3f, -1}},
               {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}});
  CHECK(passes(body));
  Surface surface = body;
  surface.faces.insert(surface.faces.begin() + 2, {{0, 1, 2}, {0, 2, 1}});
  surface.source.clear();
  CHECK(is_mended(surface, "dropped 2 faces that repeat others, first face 2"));
  CHECK(surface.faces == body.faces);
}

TEST(EachFaceTurnedSinglyIsTurnedBack) {
  const Surface part = make_part(2, 2000);
  for (uint32_t f = 0; f < part.faces.size(); f += test::is_long() ? 7u : 35u) {
    Surface surface = part;
    turn(surface.faces[f]);
    test::note("face", f);
    CHECK(is_mended(surface, ("turned 1 face wound against the rest of 1 piece, first face " +
                              std::to_string(f))
                                 .c_str()));
    CHECK(near(volume_of(surface), volume_of(part)));
  }
  for (const Surface& small : {tetrahedron(), cube()}) {
    for (uint32_t f = 0; f < small.faces.size(); ++f) {
      Surface surface = small;
      turn(surface.faces[f]);
      CHECK(is_mended(surface, "turned 1 face"));
      CHECK(near(volume_of(surface), volume_of(small)));
    }
  }
}

TEST(RandomlyTurnedFacesAreTurnedBack) {
  const Surface part = make_part(5, 2000);
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    Random random(seed);
    Surface surface = part;
    for (Face& face : surface.faces) {
      if (random.below(10) < seed) turn(face);
    }
    CHECK(is_mended(surface, "turned"));
    CHECK(near(volume_of(surface), volume_of(part)));
  }
}

TEST(AnInsideOutSurfaceIsTurned) {
  Surface surface = cube();
  for (Face& face : surface.faces) turn(face);
  CHECK(is_mended(surface, "turned 1 piece of 12 faces wound inside out"));
  CHECK(near(volume_of(surface), 8));
}

// Each shell is compared only with those around it: thousands of hollow cubes take no longer than
// their faces.
TEST(ThousandsOfHollowPiecesAreEachHollow) {
  constexpr int kSide = 14;
  Surface foam;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const math::Vec3 at{static_cast<float>(i % kSide) * 8,
                        static_cast<float>(i / kSide % kSide) * 8,
                        static_cast<float>(i / kSide / kSide) * 8};
    append(foam, cube(at, 2));
    append(foam, cube(at, 1));
  }
  const CheckReport report = check_and_mend(foam, {});
  CHECK(report.usable());
  CHECK(near(volume_of(foam) / (kSide * kSide * kSide), 64 - 8));
}

TEST(CavitiesAreInwardAndWhatLiesInThemOutward) {
  for (int wound = 0; wound < 16; ++wound) {  // which of the four shells are inside out at first
    Surface nested = cube({0, 0, 0}, 4);
    append(nested, cube({0.5f, 0, 0}, 2));
    append(nested, cube({0.5f, 0, 0}, 1));
    append(nested, cube({20, 0, 0}, 1));  // beside it
    for (uint32_t f = 0; f < nested.faces.size(); ++f) {
      if ((wound >> (f / 12) & 1) != 0) turn(nested.faces[f]);
    }
    test::note("wound", wound);
    const CheckReport report = check_and_mend(nested, {});
    CHECK(report.usable());
    CHECK(near(volume_of(nested), 512 - 64 + 8 + 8));
    CHECK(near(winding_by_angles(nested, {3.5, 0, 0}), 1));
    CHECK(near(winding_by_angles(nested, {2.2, 0, 0}), 0));
    CHECK(near(winding_by_angles(nested, {0.5, 0, 0}), 1));
    CHECK_EQ(report.mended.empty(), wound == 2);
  }
}

TEST(BodiesThatOverlapAreNotNested) {
  Surface two = cube();
  append(two, cube({1, 0.5f, 0.25f}, 0.9f));
  CHECK(passes(two));
  Surface poking = tetrahedron();
  append(poking, cube({0.3f, 0.3f, 0.3f}, 0.15f));  // one corner pokes out of the slanted face
  CHECK(passes(poking));
}

TEST(OpenEdgesAreRefusedWithTheFirst) {
  Surface surface = cube();
  surface.faces.erase(surface.faces.begin());
  CHECK(is_refused(surface, "3 open edges around 1 hole",
                   "the edge from vertex 0 (-1, -1, -1 m) to vertex 2 (-1, 1, -1 m) of face 8"));
}

TEST(CrowdedEdgesAreRefusedWithTheirFaces) {
  Surface surface = tetrahedron();  // two tetrahedra on one edge
  surface.vertices.insert(surface.vertices.end(), {{0, -1, 0}, {0, 0, -1}});
  append(surface, tetrahedron());
  for (uint32_t f = 4; f < 8; ++f) {
    for (uint32_t& v : surface.faces[f]) v = v - 6 < 2 ? v - 6 : v - 4;  // 0 and 1 are shared
  }
  CHECK(is_refused(
      surface, "1 edge that more than two faces share (non-manifold)",
      "the edge from vertex 0 (0, 0, 0 m) to vertex 1 (1, 0, 0 m) of 4 faces (0, 1, 4, 5)"));
}

TEST(PinchedVerticesAreRefused) {
  Surface surface = tetrahedron();
  append(surface, tetrahedron());
  for (uint32_t f = 4; f < 8; ++f) {
    for (uint32_t& v : surface.faces[f]) v = v == 4 ? 0 : v;
  }
  for (uint32_t v = 4; v < 8; ++v) surface.vertices[v].x -= 3;
  CHECK(is_refused(surface, "1 vertex where separate sheets touch",
                   "first vertex 0 (0, 0, 0 m) of 2 sheets"));
}

TEST(SurfacesWithOneSideAreRefused) {
  Surface klein;  // a grid closed straight one way and mirrored the other
  constexpr uint32_t kSide = 6;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    klein.vertices.push_back({static_cast<float>(i % kSide), static_cast<float>(i / kSide),
                              static_cast<float>(i * i % 7)});
  }
  const auto at = [](uint32_t x, uint32_t y) {
    const uint32_t mirrored = y == kSide ? (kSide - x) % kSide : x % kSide;
    return mirrored + (y % kSide) * kSide;
  };
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      klein.faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      klein.faces.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  CHECK(is_refused(klein, "1 piece with one side alone", "face"));
}

TEST(WhatCannotBeMeasuredIsAlwaysRefused) {
  CHECK(is_always_refused({}, "no faces"));
  for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
    Surface surface = cube();
    surface.vertices[6].y = bad;
    CHECK(
        is_always_refused(surface, "1 vertex has coordinates that are not finite, first vertex 6"));
  }
  Surface surface = cube();
  surface.faces[4][1] = 8;
  CHECK(is_always_refused(surface, "face 4 names vertex 8 of 8"));
  CHECK(is_always_refused(cube({0, 0, 0}, 4e-7f), "large, beyond what is rendered"));
  CHECK(is_always_refused(cube({0, 0, 0}, 6e5f), "large, beyond what is rendered"));
  CHECK(is_always_refused(cube({1e6f, 0, 0}, 1), "lies 1e+06 m from the origin"));
  CHECK(passes(cube({0, 0, 0}, 6e-7f)));
  CHECK(passes(cube({0, 0, 0}, 4e5f)));
  CHECK(passes(cube({1e3f, 0, 0}, 1)));
}

TEST(APillowOfTwoFacesIsNoSolid) {
  Surface surface = numbered({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  CheckReport report = check_and_mend(surface, {});
  CHECK(!report.usable());
}

}  // namespace firmtouch::tools
