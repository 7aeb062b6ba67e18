#include "firmtouch/mesh/segment_cast.hpp"

#include "firmtouch/mesh/crossing_takers.hpp"
#include "firmtouch/mesh/segment_search.hpp"

namespace firmtouch::mesh {

using math::Vec3;

Hit cast_segment(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  Hit hit;
  First first(hit);
  hit.exact = search(mesh, a_m, b_m, budget, first, hit.steps);
  return hit;
}

Hit any_crossing(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  Hit hit;
  Any any(hit);
  hit.exact = search(mesh, a_m, b_m, budget, any, hit.steps);
  return hit;
}

Crossings all_crossings(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget,
                        core::Span<SurfaceCrossing> buffer) {
  All all(buffer);
  all.crossings.exact = search(mesh, a_m, b_m, budget, all, all.crossings.steps);
  return all.crossings;
}

}  // namespace firmtouch::mesh
