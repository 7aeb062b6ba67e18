#pragma once
// A triangle against boxes and other triangles. For the library's own translation units.

#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/mesh/exact_crossing.hpp"
#include "firmtouch/mesh/segment_frame.hpp"

namespace firmtouch::hull {

/// Whether two triangles cross is decided without any rounding, also where they touch, share an
/// edge or lie in one plane: as if all of this one had been moved by (e, e^2, e^3) for an
/// infinitely small e > 0. Then one crosses the other where an edge of either passes through the
/// other's inside, and nothing is only touched.
class TriangleRegion {
 public:
  /// `bounds`: the box of all vertices of later calls.
  TriangleRegion(const Box& bounds, const math::Vec3 (&corner_m)[3]);

  /// As Slabs::enter(): 0 where the triangle may meet the box, else Slabs::kNever.
  float enter(const Box& box, float) const {
    for (uint32_t k = 0; k < 3; ++k)
      if (box.high_m[k] < box_.low_m[k] || box.low_m[k] > box_.high_m[k]) return Slabs::kNever;
    return 0.0f;
  }
  bool crosses(const FacePoints& face) const;

 private:
  math::Vec3 corner_m_[3];
  Box box_;
  mesh::SegmentFrame edge_[3];
};

static inline bool is_finite(const math::Vec3 (&corner_m)[3]) {
  return math::is_finite(corner_m[0]) && math::is_finite(corner_m[1]) &&
         math::is_finite(corner_m[2]);
}

/// Faces of a base hull in the leaves that a triangle may meet.
template <class Use>
struct RegionFaces {
  const BaseHull& base_hull;
  const Use& use;
  float limit = 1;
  bool leaf(uint32_t i) {
    const BaseHull::Leaf leaf = base_hull.leaf(i);
    for (uint32_t n = 0; n < leaf.faces.size(); ++n)
      if (!use(leaf, n)) return false;
    return true;
  }
};
/// Calls use(leaf, n) for them until one returns false. Result: false if the budget ran out.
template <class Use>
bool faces_near(const BaseHull& base_hull, const TriangleRegion& region, query::Work& work,
                const Use& use) {
  RegionFaces<Use> faces{base_hull, use};
  return descend<false>(base_hull.boxes(), box_of(base_hull.head()), region, work, faces).is_done;
}

}  // namespace firmtouch::hull
