#include "../surface/shapes.hpp"

#include <set>

#include "harness/test.hpp"
#include "hull/build_hull.hpp"
#include "surface/check/check.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::tools {
namespace {

ProgressiveHull built(const Surface& surface, HullOptions options, HullReport& report) {
  return build_hull(surface, options, report);
}

HullOptions options_of(HullStrategy strategy, uint32_t faces) {
  HullOptions options;
  options.strategy = strategy;
  options.target_faces = faces;
  return options;
}

constexpr HullStrategy kAll[] = {HullStrategy::kVolume, HullStrategy::kCentre,
                                 HullStrategy::kLazyVolume};

bool same_collapses(const ProgressiveHull& a, const ProgressiveHull& b) {
  if (a.collapses.size() != b.collapses.size() || a.links != b.links) return false;
  for (size_t k = 0; k < a.collapses.size(); ++k) {
    if (a.collapses[k].u != b.collapses[k].u || a.collapses[k].v != b.collapses[k].v) return false;
    const math::Vec3 p = a.vertices_m[a.mesh_vertices + k], q = b.vertices_m[b.mesh_vertices + k];
    if (p.x < q.x || p.x > q.x || p.y < q.y || p.y > q.y || p.z < q.z || p.z > q.z) return false;
  }
  return true;
}

// A face by its vertices, from the lowest on.
Face turned(Face face) {
  while (face[0] > face[1] || face[0] > face[2]) face = {face[1], face[2], face[0]};
  return face;
}

std::set<Face> faces_of(const Surface& level) {
  std::set<Face> faces;
  for (const Face& face : level.faces) faces.insert(turned(face));
  return faces;
}

}  // namespace

TEST(EveryLevel_IsClosed_EnclosesTheFinerOne) {
  const Surface part = make_part(1, 4000);
  for (const HullStrategy strategy : kAll) {
    test::note("strategy", static_cast<int64_t>(strategy));
    HullReport report;
    const ProgressiveHull hull = built(part, options_of(strategy, 200), report);
    double before = volume_of(part);
    for (uint32_t faces = 4000; faces >= 250; faces /= 2) {
      const Surface level = hull_level(hull, faces);
      CHECK_LE(level.faces.size(), faces);
      CHECK_LE(std::min<size_t>(faces, part.faces.size()), level.faces.size() + 1);
      CHECK(is_closed_and_alike(level));
      const double volume = volume_of(level);
      CHECK_LE(before, volume);
      CHECK_LT(std::fabs(volume - enclosed_volume_m3(level)), 1e-9 * volume);
      before = volume;
    }
  }
}

TEST(VolumesOfCollapsesAddUpToTheVoid) {
  const Surface part = make_part(3, 3000);
  HullReport report;
  const ProgressiveHull hull = built(part, options_of(HullStrategy::kVolume, 500), report);
  double sum = volume_of(part);
  for (const Collapse& collapse : hull.collapses) sum += collapse.volume_m3;
  CHECK_LT(std::fabs(sum - volume_of(hull_level(hull, 500))), 1e-9 * sum);
}

TEST(TreeAndHeap_GiveTheSameHull_InEveryRun) {
  const Surface part = make_part(2, 3000);
  for (const HullStrategy strategy : kAll) {
    HullOptions options = options_of(strategy, 300);
    HullReport first, second, third;
    const ProgressiveHull tree = built(part, options, first);
    const ProgressiveHull again = built(part, options, second);
    options.queue = QueueKind::kHeap;
    const ProgressiveHull heap = built(part, options, third);
    CHECK(same_collapses(tree, again));
    CHECK(same_collapses(tree, heap));
    CHECK_EQ(first.counts.programs, third.counts.programs);
  }
}

TEST(RecordedStars_AreTheFacesOfEachCollapse) {
  const Surface part = make_part(1, 2000);
  HullReport report;
  const ProgressiveHull hull = built(part, options_of(HullStrategy::kLazyVolume, 1000), report);
  CHECK_LT(400, hull.collapses.size());
  std::set<Face> now = faces_of(part);
  for (uint32_t k = 0; k < hull.collapses.size(); ++k) {
    test::note("collapse", k);
    const Collapse& c = hull.collapses[k];
    const uint32_t* link = &hull.links[c.first_link];
    const uint32_t made = hull.mesh_vertices + k;
    CHECK_EQ(now.erase(turned({c.u, c.v, link[0]})), 1u);
    CHECK_EQ(now.erase(turned({c.v, c.u, link[c.split]})), 1u);
    for (uint32_t i = 0; i < c.link_count; ++i) {
      const uint32_t next = link[(i + 1) % c.link_count];
      CHECK_EQ(now.erase(turned({i < c.split ? c.u : c.v, link[i], next})), 1u);
      now.insert(turned({made, link[i], next}));
    }
    if (k % 100 == 0) CHECK(now == faces_of(hull_after(hull, k + 1)));
  }
}

TEST(LimitsHoldForEveryCollapse) {
  const Surface part = make_part(1, 4000);
  HullOptions options = options_of(HullStrategy::kLazyVolume, 4);
  options.limits.max_valence = 9;
  HullReport report;
  const ProgressiveHull hull = built(part, options, report);
  for (const Collapse& collapse : hull.collapses) CHECK_LE(collapse.link_count, 9u);
  CHECK_LT(0u, report.counts.valence);
  CHECK_LT(0u, report.counts.compactness);
  CHECK_LT(0u, report.counts.deviation);
}

TEST(UnreachableTarget_StopsWithPositionAndReason) {
  const Surface part = make_part(1, 2000);
  HullReport report;
  const ProgressiveHull hull = built(part, options_of(HullStrategy::kLazyVolume, 4), report);
  CHECK(says(report.stalled, "stops at " + std::to_string(hull.min_faces()) + " faces of the 4"));
  CHECK(says(report.stalled, "first the edge at vertex"));
  CHECK(says(report.stalled, "loosen"));
  CHECK(is_closed_and_alike(hull_level(hull, 4)));
  CHECK_EQ(hull_level(hull, 4).faces.size(), hull.min_faces());
}

TEST(Tetrahedron_AndTargetAboveTheMesh_ChangeNothing) {
  HullReport report;
  const Surface body = tetrahedron();
  CHECK(same(hull_level(built(body, options_of(HullStrategy::kVolume, 4), report), 4), body));
  CHECK(report.stalled.empty());
  const Surface part = make_part(1, 2000);
  const ProgressiveHull hull = built(part, options_of(HullStrategy::kVolume, 1000000), report);
  CHECK(hull.collapses.empty() && report.stalled.empty());
  CHECK_EQ(hull_level(hull, 1000000).faces.size(), part.faces.size());
}

TEST(PiecesCoarsenEachByItself) {
  Surface two = make_part(1, 2000);
  const Surface one = two;
  Surface other = make_part(2, 2000);
  for (math::Vec3& v : other.vertices) v.x += 0.5f;
  append(two, other);
  HullReport report;
  const ProgressiveHull hull = built(two, options_of(HullStrategy::kLazyVolume, 1000), report);
  const Surface level = hull_level(hull, 1000);
  CHECK(is_closed_and_alike(level));
  size_t left = 0;
  for (const Face& face : level.faces) {
    const bool is_left = level.vertices[face[0]].x < 0.25f;
    CHECK(is_left == (level.vertices[face[1]].x < 0.25f));
    left += is_left ? 1 : 0;
  }
  CHECK_LT(100, left);
  CHECK_LT(left, level.faces.size() - 100);
}

}  // namespace firmtouch::tools
