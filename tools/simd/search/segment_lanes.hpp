#pragma once
// mesh::SegmentFrame's test of eight triangles at once: the same formulas in the same order, so the
// same bits.

#include "firmtouch/mesh/segment_frame.hpp"
#include "simd/search/block_triangles.hpp"
#include "simd/search/double_crossing.hpp"
#include "simd/search/triangle_lanes.hpp"

namespace firmtouch::simd {

using mesh::Crossing;
using mesh::Head;
using mesh::Pass;
using mesh::SegmentLine;
using mesh::Shear;

class SegmentLanes : private SegmentLine {
 public:
  [[gnu::always_inline]] inline SegmentLanes(const Head& head, math::Vec3 a_m, math::Vec3 b_m)
      : SegmentLine(head.low_m, head.high_m, a_m, b_m), shear_(along_m_) {
    flips_ = shear_.is_back;
    const float at_m[3] = {a_m.x, a_m.y, a_m.z};
    at_i_m_ = at_m[shear_.i], at_j_m_ = at_m[shear_.j], at_k_m_ = at_m[shear_.k];
  }

  /// SegmentFrame::crossing() of a triangle whose edges the line passes this way.
  Crossing crossing(Pass way, math::Vec3 p, math::Vec3 q, math::Vec3 r) const {
    Crossing reported;
    float early;
    return decides(way, p, q, r, reported, early) ? reported : crossing_beyond_floats(p, q, r);
  }

  /// One bit a triangle.
  struct Passes {
    uint32_t misses, enters, leaves;
    Pass of(uint32_t lane) const {  // branchless, for no predictor learns it
      static_assert(static_cast<uint32_t>(Pass::kUnsure) == 3);
      return static_cast<Pass>(3 - ((leaves >> lane) & 1u) - 2 * ((enters >> lane) & 1u));
    }
  };

  /// Of the triangles whose corners are stored in arrays of `count` floats. The bits of lanes
  /// beyond them mean nothing.
  [[gnu::always_inline]] inline Passes passes(const float* arrays, uint32_t count) const {
    const size_t stride = 3 * size_t{count};
    const float *i = arrays + shear_.i * count, *j = arrays + shear_.j * count,
                *k = arrays + shear_.k * count;
    const auto corner = [&](size_t c) {
      return sheared(lanes_from(i + c * stride), lanes_from(j + c * stride),
                     lanes_from(k + c * stride));
    };
    return pass(corner(0), corner(1), corner(2));
  }

 private:
  // noinline: rare, and large.
  [[gnu::noinline]] Crossing crossing_beyond_floats(math::Vec3 p, math::Vec3 q,
                                                    math::Vec3 r) const {
    Crossing reported;
    if (decides_in_double(a_m_, b_m_, p, q, r, reported)) return reported;
    return mesh::exact_crossing(a_m_, b_m_, p, q, r);
  }

  struct Sheared {
    Float8 x, y;
  };
  [[gnu::always_inline]] inline Sheared sheared(Float8 i, Float8 j, Float8 k) const {
    const Float8 along = k - all_of(at_k_m_);
    return {(i - all_of(at_i_m_)) + along * all_of(shear_.along_i),
            (j - all_of(at_j_m_)) + along * all_of(shear_.along_j)};
  }
  [[gnu::always_inline]] inline Passes pass(const Sheared& p, const Sheared& q,
                                            const Sheared& r) const {
    const Float8 high_x = larger(p.x, larger(q.x, r.x)), low_x = smaller(p.x, smaller(q.x, r.x));
    const Float8 high_y = larger(p.y, larger(q.y, r.y)), low_y = smaller(p.y, smaller(q.y, r.y));
    const Float8 e = all_of(coordinate_error_m_);
    const auto beside = less(e, low_x) | less(high_x, -e) | less(e, low_y) | less(high_y, -e);
    const Float8 size = larger(larger(high_x, -low_x), larger(high_y, -low_y));
    const Float8 error = all_of(side_error_m_) * size + all_of(side_error_m2_);
    const Float8 pq = p.x * q.y - p.y * q.x, qr = q.x * r.y - q.y * r.x, rp = r.x * p.y - r.y * p.x;
    const Float8 low = smaller(pq, smaller(qr, rp)), high = larger(pq, larger(qr, rp));
    return {bits_of(beside | (less(low, -error) & less(error, high))), bits_of(less(high, -error)),
            bits_of(less(error, low))};
  }

  Shear shear_;
  float at_i_m_, at_j_m_, at_k_m_;
};

/// Gives the visitor the crossings of the lanes `of`. Lane 0 is triangle `first`.
template <class Visitor, class Corners>
[[gnu::always_inline]] static inline bool take_passed(const SegmentLanes& segment,
                                                      const SegmentLanes::Passes& passes,
                                                      uint32_t of, uint32_t first,
                                                      const Corners& corners, Visitor& visitor) {
  for (uint32_t left = of & ~passes.misses; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(left));
    const math::Vec3 p = corners(lane, 0), q = corners(lane, 1), r = corners(lane, 2);
    const Crossing crossing = segment.crossing(passes.of(lane), p, q, r);
    if (crossing.direction != 0 && !visitor.take(crossing, first + lane)) return false;
  }
  return true;
}

/// The same of a leaf.
template <class Visitor>
[[gnu::always_inline]] static inline bool take_wide_leaf(const WideTree& tree,
                                                         const SegmentLanes& segment, uint32_t leaf,
                                                         Visitor& visitor) {
  const BlockTriangles triangles(tree, leaf);
  const float* const arrays = triangles.begin(tree.corners, kCornerArrays);
  const auto corner = [&](uint32_t lane, uint32_t c) {
    return vector_of(arrays + lane, 3 * c, triangles.of.count);
  };
  return take_passed(segment, segment.passes(arrays, triangles.of.count), triangles.lanes(),
                     triangles.first, corner, visitor);
}

}  // namespace firmtouch::simd
