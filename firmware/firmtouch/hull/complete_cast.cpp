#include "firmtouch/hull/complete_cast.hpp"

#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/mesh/crossing_takers.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

// Four triangles of the mesh a leaf, handed to what keeps crossings.
template <class Taker>
class Leaves {
 public:
  Leaves(const View& hull, Vec3 a_m, Vec3 b_m, Taker& taker)
      : limit(taker.limit), hull_(hull), a_m_(a_m), b_m_(b_m), taker_(taker) {}
  float limit;

  bool leaf(uint32_t leaf) {
    if (!has_frame_)
      frame_ = mesh::SegmentFrame(hull_.mesh_head().low_m, hull_.mesh_head().high_m, a_m_, b_m_);
    has_frame_ = true;
    const uint32_t first = leaf * kLeafTriangles, count = hull_.head().mesh_triangle_count;
    const uint32_t end = first + kLeafTriangles < count ? first + kLeafTriangles : count;
    for (uint32_t i = first; i < end; ++i) {
      const mesh::Triangle<uint32_t> t = hull_.triangle(i);
      const mesh::Crossing crossing =
          frame_.crossing(hull_.mesh_vertex(t.corner[0]), hull_.mesh_vertex(t.corner[1]),
                          hull_.mesh_vertex(t.corner[2]));
      if (crossing.direction != 0 && !taker_.take(crossing, i)) return false;
    }
    limit = taker_.limit;
    return true;
  }

 private:
  const View& hull_;
  Vec3 a_m_, b_m_;
  Taker& taker_;
  mesh::SegmentFrame frame_;
  bool has_frame_ = false;  // many segments reach no leaf
};

template <class Taker>
bool search(const View& hull, Vec3 a_m, Vec3 b_m, query::Budget budget, Taker& taker,
            uint32_t& steps) {
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return false;
  const mesh::Head& head = hull.mesh_head();
  const Box whole{{head.low_m[0], head.low_m[1], head.low_m[2]},
                  {head.high_m[0], head.high_m[1], head.high_m[2]}};
  Leaves<Taker> leaves(hull, a_m, b_m, taker);
  return descend(hull.boxes(), whole, Slabs(a_m, b_m), budget.steps == 0 ? 1 : budget.steps, steps,
                 leaves);
}

}  // namespace

mesh::Hit cast_segment(const View& hull, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  mesh::Hit hit;
  mesh::First first(hit);
  hit.exact = search(hull, a_m, b_m, budget, first, hit.steps);
  return hit;
}

mesh::Hit any_crossing(const View& hull, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  mesh::Hit hit;
  mesh::Any any(hit);
  hit.exact = search(hull, a_m, b_m, budget, any, hit.steps);
  return hit;
}

mesh::Crossings all_crossings(const View& hull, Vec3 a_m, Vec3 b_m, query::Budget budget,
                              core::Span<mesh::SurfaceCrossing> buffer) {
  mesh::All all(buffer);
  all.crossings.exact = search(hull, a_m, b_m, budget, all, all.crossings.steps);
  return all.crossings;
}

}  // namespace firmtouch::hull
