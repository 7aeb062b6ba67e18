#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"

// Faces without area go, the surface stays closed, no vertex moves.

namespace firmtouch::tools {
namespace {

uint32_t flat_count(const Surface& surface) {
  uint32_t count = 0;
  for (const Face& f : surface.faces) {
    const Point a = to_point(surface.vertices[f[0]]);
    count += length(cross(to_point(surface.vertices[f[1]]) - a,
                          to_point(surface.vertices[f[2]]) - a)) > 0
                 ? 0u
                 : 1u;
  }
  return count;
}

// Whether all vertices of `after` are of `before`, as the report numbers them.
bool stand_still(const Surface& before, const Surface& after, const CheckReport& report) {
  for (uint32_t v = 0; v < after.vertices.size(); ++v) {
    const Point moved =
        to_point(after.vertices[v]) - to_point(before.vertices[report.vertex_source[v]]);
    if (dot(moved, moved) > 0) return false;
  }
  return report.vertex_source.size() == after.vertices.size();
}

bool loses_its_flat_faces(const Surface& before, const char* how) {
  Surface surface = before;
  const CheckReport report = check_and_mend(surface, {});
  for (const std::string& line : report.refused) std::printf("  refused: %s\n", line.c_str());
  const bool good = report.usable() && says(report.mended, how) && is_closed_and_alike(surface) &&
                    flat_count(surface) == 0 && stand_still(before, surface, report) &&
                    std::fabs(volume_of(surface) - volume_of(before)) < 1e-9;
  if (!good) {
    for (const std::string& line : report.mended) std::printf("  mended: %s\n", line.c_str());
  }
  return good;
}

// A vertex in the middle of edge k of face f: one neighbour is split in two, the other gets a cap
// along its edge.
Surface with_cap(Surface surface, uint32_t f, uint32_t k) {
  const uint32_t a = surface.faces[f][k], b = surface.faces[f][(k + 1) % 3],
                 c = surface.faces[f][(k + 2) % 3];
  const uint32_t middle = static_cast<uint32_t>(surface.vertices.size());
  surface.vertices.push_back(
      to_vec3((to_point(surface.vertices[a]) + to_point(surface.vertices[b])) * 0.5));
  surface.faces[f] = {a, middle, c};
  surface.faces.push_back({middle, b, c});
  surface.faces.push_back({b, middle, a});
  surface.source.clear();
  return surface;
}

// Vertex v doubled across the edge of face f from corner k: two needles fill the slit.
Surface with_needles(Surface surface, uint32_t v, uint32_t left, uint32_t right) {
  const uint32_t twin = static_cast<uint32_t>(surface.vertices.size());
  surface.vertices.push_back(surface.vertices[v]);
  // The fan of v from `left` round to `right` goes to the twin.
  uint32_t at = left;
  while (at != right) {
    for (Face& face : surface.faces) {
      bool done = false;
      for (uint32_t k = 0; k < 3 && !done; ++k) {
        if (face[k] == v && face[(k + 1) % 3] == at) {
          face[k] = twin;
          at = face[(k + 2) % 3];
          done = true;
        }
      }
      if (done) break;
    }
  }
  surface.faces.push_back({v, left, twin});
  surface.faces.push_back({v, twin, right});
  surface.source.clear();
  return surface;
}

}  // namespace

TEST(CapsAreFlippedAway) {
  for (const Surface& body : {tetrahedron(), cube()}) {
    for (uint32_t f = 0; f < body.faces.size(); ++f) {
      for (uint32_t k = 0; k < 3; ++k) {
        test::note("face and edge", 10 * f + k);
        CHECK(loses_its_flat_faces(with_cap(body, f, k), "removed 1 face without area"));
      }
    }
  }
}

TEST(CapsOnTwoEdgesOfOneFaceAreFlippedAway) {
  const Surface once = with_cap(cube(), 0, 0);
  CHECK(loses_its_flat_faces(with_cap(once, 12, 1), "removed 2 faces without area"));
  CHECK(loses_its_flat_faces(with_cap(once, 13, 1), "without area"));  // a cap on a cap
}

TEST(NeedlesAreCollapsed) {
  const Surface body = cube();
  CHECK(loses_its_flat_faces(with_needles(body, 0, 1, 4),
                             "removed 2 faces without area, first face 12"));
  CHECK(loses_its_flat_faces(with_needles(body, 7, 3, 4), "and 1 collapse"));
}

TEST(ANeedleAcrossANeckIsRefused) {
  // A tube of two triangles' rings between two tips. Corners 1 and 2 of the upper ring lie at one
  // place: to collapse their edge would pinch the tube.
  const Surface tube = numbered({{0, 0, 2},
                                 {1, 0, 1},
                                 {1, 0, 1},
                                 {-1, 0, -1},
                                 {1, -1, -1},
                                 {1, 1, -1},
                                 {-1, 0, 1},
                                 {0, 0, -2}},
                                faces_of("012 026 061 145 152 253 236 634 641 754 735 743"));
  CHECK(is_closed_and_alike(tube));
  Surface strict = tube, loose = tube;
  const CheckReport report = check_and_mend(strict, {});
  CHECK(says(report.refused,
             "2 faces without area that cannot be removed without a crack, first face 0"));
  CHECK(check_and_mend(loose, {true}).usable());
  CHECK_EQ(flat_count(loose), 0u);
}

TEST(ANeedleOfATetrahedronIsRefused) {
  Surface flat = tetrahedron();
  flat.vertices[1] = flat.vertices[0];
  const CheckReport report = check_and_mend(flat, {});
  CHECK(says(report.refused, "2 faces without area that cannot be removed without a crack"));
}

TEST(FlatFacesOfAnOpenSurfaceAreDroppedWhereItNeedNotClose) {
  Surface sheet = numbered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 2, 3}, {0, 1, 2}});
  Surface strict = sheet;
  CHECK(!check_and_mend(strict, {}).usable());
  const CheckReport report = check_and_mend(sheet, {true});
  CHECK(report.usable());
  CHECK_EQ(flat_count(sheet), 0u);
  CHECK(!sheet.faces.empty());
}

TEST(AFlatBodyIsRefused) {
  Surface line = numbered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, tetrahedron().faces);
  Surface loose = line;
  CHECK(!check_and_mend(line, {}).usable());
  CHECK(says(check_and_mend(loose, {true}).refused, "no face with an area"));
}

}  // namespace firmtouch::tools
