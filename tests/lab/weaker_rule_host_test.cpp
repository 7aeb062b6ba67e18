// Splits that require only the two side faces (Hoppe 1997) lose crossings; those that require the
// whole link do not. Both by a refinement that maps every face of the mesh, so without the graph's
// own shortcuts.
#include <algorithm>
#include <set>

#include "../surface/shapes.hpp"
#include "harness/test.hpp"
#include "hull/build_hull.hpp"
#include "lab/published_refinement.hpp"
#include "surface/edges.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

enum class Needs { kWholeLink, kSideFaces };

class Mapped {
 public:
  Mapped(const ProgressiveHull& hull, Needs needs) : hull_(hull), needs_(needs) {}

  /// Faces of the mesh that the refined hull is crossed at.
  std::set<uint32_t> crossed(const Segment& s) {
    is_split_.assign(hull_.collapses.size(), false);
    while (true) {
      map_vertices();
      std::set<uint32_t> found, requested;
      for (uint32_t f = 0; f < hull_.mesh_faces.size(); ++f) {
        const Face& mesh = hull_.mesh_faces[f];
        const Face face{stands_for_[mesh[0]], stands_for_[mesh[1]], stands_for_[mesh[2]]};
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        if (!crosses(face, s)) continue;
        bool is_of_mesh = true;
        for (const uint32_t corner : face) {
          if (corner < hull_.mesh_vertices) continue;
          is_of_mesh = false;
          requested.insert(corner - hull_.mesh_vertices);
        }
        if (is_of_mesh) found.insert(f);
      }
      if (requested.empty()) return found;
      for (const uint32_t k : requested) split(k);
    }
  }

 private:
  void map_vertices() {
    stands_for_.resize(hull_.vertices_m.size());
    for (uint32_t v = static_cast<uint32_t>(stands_for_.size()); v-- > 0;) {
      const uint32_t by = hull_.removed_by[v];
      stands_for_[v] = by == kNone || is_split_[by] ? v : stands_for_[hull_.mesh_vertices + by];
    }
  }
  void split(uint32_t collapse) {
    std::vector<uint32_t> queue{collapse};
    for (size_t at = 0; at < queue.size(); ++at) {
      const uint32_t k = queue[at];
      if (k == kNone || is_split_[k]) continue;
      is_split_[k] = true;
      const Collapse& c = hull_.collapses[k];
      queue.push_back(hull_.removed_by[hull_.mesh_vertices + k]);
      for (uint32_t i = 0; i < c.link_count; ++i) {
        const bool is_side = i == 0 || i == c.split;
        if (needs_ == Needs::kWholeLink || is_side)
          queue.push_back(hull_.removed_by[hull_.links[c.first_link + i]]);
      }
    }
  }
  bool crosses(const Face& face, const Segment& s) const {
    const Point a = to_point(hull_.vertices_m[face[0]]) - s.from_m,
                b = to_point(hull_.vertices_m[face[1]]) - s.from_m,
                c = to_point(hull_.vertices_m[face[2]]) - s.from_m, along = s.to_m - s.from_m;
    const double x = dot(along, cross(a, b)), y = dot(along, cross(b, c)),
                 z = dot(along, cross(c, a));
    if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return false;
    const double t = dot(a, cross(b, c)) / (x + y + z);
    return t >= 0 && t <= 1;
  }

  const ProgressiveHull& hull_;
  Needs needs_;
  std::vector<bool> is_split_;
  std::vector<uint32_t> stands_for_;
};

}  // namespace

TEST(SplittingSideFacesOnly_LosesCrossings_WholeLinkDoesNot) {
  const Surface part = make_part(1, 2000);
  HullOptions options;
  options.target_faces = 100;
  HullReport report;
  const ProgressiveHull hull = build_hull(part, options, report);
  Mapped whole(hull, Needs::kWholeLink), sides(hull, Needs::kSideFaces);
  Refinement refinement(hull, 100);
  RefinementCounts counts;
  Random random(4);
  size_t crossings = 0, lost = 0, differing = 0;
  for (int i = 0; i < 400; ++i) {
    const Point out{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Point aim{random.between(-0.045, 0.045), random.between(-0.03, 0.03),
                    random.between(-0.012, 0.012)};
    const Segment s{out * (0.5 / length(out)), aim * 2 - out * (0.5 / length(out))};
    const std::set<uint32_t> of_whole = whole.crossed(s), of_sides = sides.crossed(s);
    crossings += of_whole.size();
    for (const uint32_t face : of_whole) lost += of_sides.count(face) == 0 ? 1u : 0u;
    std::set<uint32_t> of_graph;
    for (const SegmentHit& hit : refinement.hits(s, counts)) of_graph.insert(hit.face);
    differing += of_graph == of_whole ? 0u : 1u;
  }
  test::note("crossings", static_cast<int64_t>(crossings));
  test::note("lost", static_cast<int64_t>(lost));
  CHECK_LT(200u, crossings);
  CHECK_LT(0u, lost);
  CHECK_EQ(differing, 0u);
}

}  // namespace firmtouch::tools
