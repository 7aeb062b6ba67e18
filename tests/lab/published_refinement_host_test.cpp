#include <algorithm>
#include <set>

#include "../surface/shapes.hpp"
#include "harness/test.hpp"
#include "hull/build_hull.hpp"
#include "lab/published_refinement.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

Face turned(Face face) {
  while (face[0] > face[1] || face[0] > face[2]) face = {face[1], face[2], face[0]};
  return face;
}

ProgressiveHull hull_of(const Surface& mesh, uint32_t faces) {
  HullOptions options;
  options.target_faces = faces;
  HullReport report;
  return build_hull(mesh, options, report);
}

// Every crossing, face by face, in extended precision.
std::vector<SegmentHit> by_force(const Surface& mesh, const Segment& s) {
  using Real = long double;
  std::vector<SegmentHit> hits;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Point a = to_point(mesh.vertices[mesh.faces[f][0]]),
                b = to_point(mesh.vertices[mesh.faces[f][1]]),
                c = to_point(mesh.vertices[mesh.faces[f][2]]);
    const auto volume = [](Point p, Point q, Point r, Point t) {
      const Point u = q - p, v = r - p, w = t - p;
      return static_cast<Real>(u.x) *
                 (static_cast<Real>(v.y) * w.z - static_cast<Real>(v.z) * w.y) +
             static_cast<Real>(u.y) *
                 (static_cast<Real>(v.z) * w.x - static_cast<Real>(v.x) * w.z) +
             static_cast<Real>(u.z) * (static_cast<Real>(v.x) * w.y - static_cast<Real>(v.y) * w.x);
    };
    const Real from = volume(a, b, c, s.from_m), to = volume(a, b, c, s.to_m);
    if ((from > 0) == (to > 0)) continue;
    const Real x = volume(s.from_m, s.to_m, a, b), y = volume(s.from_m, s.to_m, b, c),
               z = volume(s.from_m, s.to_m, c, a);
    if (!((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0))) continue;
    hits.push_back({static_cast<double>(from / (from - to)), f});
  }
  std::sort(hits.begin(), hits.end(),
            [](const SegmentHit& a, const SegmentHit& b) { return a.t < b.t; });
  return hits;
}

Point around(Random& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

}  // namespace

TEST(SplittingEverythingRestoresTheMeshFromEveryBase) {
  const Surface part = make_part(1, 3000);
  const ProgressiveHull hull = hull_of(part, 100);
  std::set<Face> wanted;
  for (const Face& face : part.faces) wanted.insert(turned(face));
  for (const uint32_t base : {100u, 300u, 1001u, 2000u, 2998u, 1000000u}) {
    test::note("base", base);
    Refinement refinement(hull, base);
    const std::vector<Face> faces = refinement.all_split();
    std::set<Face> found;
    for (const Face& face : faces) found.insert(turned(face));
    CHECK_EQ(faces.size(), part.faces.size());
    CHECK(found == wanted);
  }
}

TEST(FirstAndLastHitFromOutsideAreThoseOfBruteForce) {
  const Surface part = make_part(1, 3000);
  const ProgressiveHull hull = hull_of(part, 100);
  for (const uint32_t base : {100u, 500u, 1500u}) {
    Refinement refinement(hull, base);
    refinement.coarsen_between(base == 500);  // another state before each query, the same answers
    RefinementCounts counts;
    Random random(11);
    size_t hit = 0, all = 0, missed = 0;
    for (int k = 0; k < 600; ++k) {
      test::note("segment", k);
      const Point out = around(random, 1);
      const Segment s{out * (0.5 / length(out)), around(random, 0.04)};
      const Segment through{s.from_m, s.to_m * 2 - s.from_m};
      const std::vector<SegmentHit> wanted = by_force(part, through),
                                    found = refinement.hits(through, counts);
      CHECK_EQ(found.empty(), wanted.empty());
      CHECK_LE(found.size(), wanted.size());
      if (found.empty() || wanted.empty()) continue;
      CHECK_LT(std::fabs(found.front().t - wanted.front().t), 1e-9);
      CHECK_LT(std::fabs(found.back().t - wanted.back().t), 1e-9);
      ++hit;
      all += wanted.size();
      missed += wanted.size() - found.size();
    }
    CHECK_LT(200, hit);
    CHECK_LT(missed * 10, all);
    CHECK_LT(0, counts.splits);
  }
}

TEST(AQueryLeavesNoTrace) {
  const Surface part = make_part(1, 2000);
  const ProgressiveHull hull = hull_of(part, 200);
  Refinement refinement(hull, 200);
  Random random(12);
  for (int k = 0; k < 100; ++k) {
    const Segment s{around(random, 0.2), around(random, 0.2)};
    RefinementCounts first, second, other;
    (void)refinement.hits(s, first);
    (void)refinement.hits({around(random, 0.2), around(random, 0.2)}, other);
    (void)refinement.hits(s, second);
    CHECK(first.tests == second.tests && first.splits == second.splits);
  }
}

}  // namespace firmtouch::tools
