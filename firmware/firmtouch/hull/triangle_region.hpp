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
  /// `low_m`, `high_m`: the box of all vertices of later calls.
  TriangleRegion(const float (&low_m)[3], const float (&high_m)[3],
                 const math::Vec3 (&corner_m)[3]);

  /// As Slabs::enter(): 0 where the triangle may meet the box, else Slabs::kNever.
  float enter(const Box& box, float) const {
    for (uint32_t k = 0; k < 3; ++k)
      if (box.high_m[k] < box_.low_m[k] || box.low_m[k] > box_.high_m[k]) return Slabs::kNever;
    return 0.0f;
  }
  bool crosses(math::Vec3 p_m, math::Vec3 q_m, math::Vec3 r_m) const;

 private:
  math::Vec3 corner_m_[3];
  Box box_;
  mesh::SegmentFrame edge_[3];
};

}  // namespace firmtouch::hull
