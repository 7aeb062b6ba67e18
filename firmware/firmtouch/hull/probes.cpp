#include "firmtouch/hull/probes.hpp"

#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/math/isa.hpp"

namespace firmtouch::hull {

void Prober::answer(const View& hull, math::Vec3 p_m, const query::Budget& budget,
                    core::Hash& hash) {
  // Three queries, and crossings that integers decide.
  const query::Budget share{budget.work / 8};
  const BaseHullDistance near = base_hull_distance(hull.base_hull(), p_m, share);
  const BaseHullHit of_base_hull = cast_base_hull(hull.base_hull(), from_m, p_m, share);
  const mesh::Hit of_mesh = cast_segment(hull, from_m, p_m, share);
  const float values[] = {near.lower_m,   near.deepest_m, near.point_m.x, near.point_m.y,
                          near.point_m.z, near.normal.x,  near.normal.y,  near.normal.z,
                          of_base_hull.t, of_mesh.t};
  for (const float value : values) hash.add(math::bits_of(value));
  hash.add(near.steps << 2 | static_cast<uint32_t>(near.side));
  hash.add(of_base_hull.steps << 2 | (of_base_hull.hit ? 1u : 0u) | (of_base_hull.exact ? 2u : 0u));
  hash.add(of_base_hull.face);
  hash.add(of_mesh.steps << 1 | (of_mesh.hit ? 1u : 0u));
  hash.add(of_mesh.triangle);
  from_m = p_m;
}

uint64_t probe_hash(const View& hull, core::Span<const query::ProbePoint> points) {
  return query::hash_of_run<ProbeRun>(hull, points);
}

}  // namespace firmtouch::hull
