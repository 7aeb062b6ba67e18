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
    const bool is_wanted = each_triangle(hull_, leaf, [&](uint32_t i) {
      const FacePoints t = points_of(hull_, i);
      const mesh::Crossing crossing = frame_.crossing(t.p_m, t.q_m, t.r_m);
      return crossing.direction == 0 || taker_.take(crossing, i);
    });
    limit = taker_.limit;
    return is_wanted;
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
  query::Work work(budget);
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return false;
  Leaves<Taker> leaves(hull, a_m, b_m, taker);
  const bool is_done =
      descend<true>(hull.boxes(), box_of(hull.mesh_head()), Slabs(a_m, b_m), work, leaves).is_done;
  steps = work.visits();
  return is_done;
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
