#include "firmtouch/hull/probes.hpp"

#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/math/isa.hpp"

namespace firmtouch::hull {
namespace {

math::Vec3 place_of(const query::ProbePoint& point) { return {point.x_m, point.y_m, point.z_m}; }

}  // namespace

void ProbeRun::work(const View& hull) {
  if (done()) return;
  const math::Vec3 from_m = place_of(probes_.points[next_ == 0 ? 0 : next_ - 1]),
                   p_m = place_of(probes_.points[next_]);
  ++next_;
  const BaseHullDistance near = base_hull_distance(hull.base_hull(), p_m, query::kUnlimited);
  const BaseHullHit of_base_hull = cast_base_hull(hull.base_hull(), from_m, p_m, query::kUnlimited);
  const mesh::Hit of_mesh = cast_segment(hull, from_m, p_m, query::kUnlimited);
  const float values[] = {near.lower_m,   near.deepest_m, near.point_m.x, near.point_m.y,
                          near.point_m.z, near.normal.x,  near.normal.y,  near.normal.z,
                          of_base_hull.t, of_mesh.t};
  for (const float value : values) hash_.add(math::bits_of(value));
  hash_.add(near.steps << 2 | static_cast<uint32_t>(near.side));
  hash_.add(of_base_hull.steps << 2 | (of_base_hull.hit ? 1u : 0u) |
            (of_base_hull.exact ? 2u : 0u));
  hash_.add(of_base_hull.face);
  hash_.add(of_mesh.steps << 1 | (of_mesh.hit ? 1u : 0u));
  hash_.add(of_mesh.triangle);
}

uint64_t probe_hash(const View& hull, core::Span<const query::ProbePoint> points) {
  ProbeRun run({points, 0});
  while (!run.done()) run.work(hull);
  return run.hash();
}

}  // namespace firmtouch::hull
