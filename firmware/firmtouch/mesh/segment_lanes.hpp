#pragma once
// SegmentFrame's test of triangles side by side: the same formulas in the same order, so the same
// bits. For the library's own translation units.

#include "firmtouch/mesh/lined.hpp"
#include "firmtouch/mesh/segment_frame.hpp"
#include "firmtouch/mesh/triangle_lanes.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {

class SegmentLanes : private SegmentLine {
 public:
  [[gnu::always_inline]] inline SegmentLanes(const Head& head, math::Vec3 a_m, math::Vec3 b_m)
      : SegmentLine(head.low_m, head.high_m, a_m, b_m), shear_(along_m_) {
    flips_ = shear_.is_back;
    const float at_m[3] = {a_m.x, a_m.y, a_m.z};
    at_i_m_ = at_m[shear_.i], at_j_m_ = at_m[shear_.j], at_k_m_ = at_m[shear_.k];
  }

  /// SegmentFrame::crossing() of a triangle that the line is known to pass so.
  Crossing crossing(Pass way, math::Vec3 p, math::Vec3 q, math::Vec3 r) const {
    Crossing reported;
    float early;
    return decides(way, p, q, r, reported, early) ? reported : exact_crossing(a_m_, b_m_, p, q, r);
  }

  /// One bit a triangle.
  struct Passes {
    uint32_t misses, enters, leaves;
    Pass of(uint32_t lane) const {
      return ((leaves >> lane) & 1u) != 0   ? Pass::kLeaves
             : ((enters >> lane) & 1u) != 0 ? Pass::kEnters
                                            : Pass::kUnsure;
    }
  };

  // Whether all of a leaf stands side by side.
  static constexpr bool kHoldsLeaf = math::kLanesOf<math::FloatWide> >= kMaxLeafTriangles;
  /// Of the triangles of a leaf whose corners lie side by side, in rows of `count` floats. Lanes that it
  /// leaves over tell nothing.
  /// Pre: kHoldsLeaf.
  [[gnu::always_inline]] inline Passes pass_rows(const float* rows, uint32_t count) const {
    using Float = math::FloatWide;
    const size_t stride = 3 * size_t{count};
    const float *i = rows + shear_.i * count, *j = rows + shear_.j * count,
                *k = rows + shear_.k * count;
    const auto corner = [&](size_t c) {
      return sheared(math::lanes_from<Float>(i + c * stride),
                     math::lanes_from<Float>(j + c * stride),
                     math::lanes_from<Float>(k + c * stride));
    };
    return pass(corner(0), corner(1), corner(2));
  }
  /// Of four triangles.
  [[gnu::always_inline]] inline Passes pass_four(const Vertex* vertices,
                                                 const Triangle<uint32_t> (&triangles)[4]) const {
    const auto corner = [&](uint32_t c) {
      const auto at = [&](uint32_t lane) { return &vertices[triangles[lane].corner[c]].x_m; };
      const math::Lanes<math::Float4> v = math::gather(at(0), at(1), at(2), at(3));
      const math::Float4 axes[3] = {v.x, v.y, v.z};
      return sheared(axes[shear_.i], axes[shear_.j], axes[shear_.k]);
    };
    return pass(corner(0), corner(1), corner(2));
  }

 private:
  template <class Float>
  struct Sheared {
    Float x, y;
  };
  template <class Float>
  [[gnu::always_inline]] inline Sheared<Float> sheared(Float i, Float j, Float k) const {
    using lanes::all_of;
    const Float along = k - all_of<Float>(at_k_m_);
    return {(i - all_of<Float>(at_i_m_)) + along * all_of<Float>(shear_.along_i),
            (j - all_of<Float>(at_j_m_)) + along * all_of<Float>(shear_.along_j)};
  }
  template <class Float>
  [[gnu::always_inline]] inline Passes pass(const Sheared<Float>& p, const Sheared<Float>& q,
                                            const Sheared<Float>& r) const {
    using lanes::all_of;
    using math::lanes_of;
    using math::larger;
    using math::less;
    using math::smaller;
    const Float high_x = larger(p.x, larger(q.x, r.x)), low_x = smaller(p.x, smaller(q.x, r.x));
    const Float high_y = larger(p.y, larger(q.y, r.y)), low_y = smaller(p.y, smaller(q.y, r.y));
    const Float e = all_of<Float>(coordinate_error_m_);
    const auto beside = less(e, low_x) | less(high_x, -e) | less(e, low_y) | less(high_y, -e);
    const Float size = larger(larger(high_x, -low_x), larger(high_y, -low_y));
    const Float error = all_of<Float>(side_error_m_) * size + all_of<Float>(side_error_m2_);
    const Float pq = p.x * q.y - p.y * q.x, qr = q.x * r.y - q.y * r.x, rp = r.x * p.y - r.y * p.x;
    const Float low = smaller(pq, smaller(qr, rp)), high = larger(pq, larger(qr, rp));
    return {lanes_of(beside | (less(low, -error) & less(error, high))),
            lanes_of(less(high, -error)), lanes_of(less(error, low))};
  }

  Shear shear_;
  float at_i_m_, at_j_m_, at_k_m_;
};

/// Takes of the triangles `asked`, from `first` on, what the segment crosses.
template <class Visitor, class Corners>
[[gnu::always_inline]] static inline bool take_passed(const SegmentLanes& segment,
                                                      const SegmentLanes::Passes& passes,
                                                      uint32_t asked, uint32_t first,
                                                      const Corners& corners, Visitor& visitor) {
  for (uint32_t left = asked & ~passes.misses; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(left));
    const math::Vec3 p = corners(lane, 0), q = corners(lane, 1), r = corners(lane, 2);
    const Crossing crossing = segment.crossing(passes.of(lane), p, q, r);
    if (crossing.direction != 0 && !visitor.take(crossing, first + lane)) return false;
  }
  return true;
}

/// take_leaf() with the triangles of a leaf that lie side by side.
template <class Visitor>
[[gnu::always_inline]] static inline bool take_lined_leaf(const Ahead& ahead,
                                                          const SegmentLanes& segment,
                                                          uint32_t leaf, Visitor& visitor) {
  const Lined lined(ahead, leaf);
  const float* const rows = lined.row(ahead.corners, kRowsOfCorners);
  const auto corner = [&](uint32_t lane, uint32_t c) {
    return one_of_rows(rows + lane, 3 * c, lined.of.count);
  };
  return take_passed(segment, segment.pass_rows(rows, lined.of.count), lined.asked(), lined.first,
                     corner, visitor);
}

/// take_leaf() with triangles side by side, gathered by fours.
template <class Visitor>
[[gnu::always_inline]] static inline bool take_leaf_in_lanes(const View& mesh,
                                                             const SegmentLanes& segment,
                                                             uint32_t leaf, Visitor& visitor) {
  const uint32_t count = leaf_count(leaf), first = leaf_first(leaf);
  for (uint32_t done = 0; done < count; done += 4) {
    const uint32_t left = count - done, asked = (1u << (left < 4 ? left : 4)) - 1u;
    Triangle<uint32_t> t[4];
    for (uint32_t lane = 0; lane < 4; ++lane)
      t[lane] = mesh.triangle(first + done + (lane < left ? lane : 0));
    const auto corner = [&](uint32_t lane, uint32_t c) { return mesh.vertex(t[lane].corner[c]); };
    if (!take_passed(segment, segment.pass_four(mesh.vertices().data(), t), asked, first + done,
                     corner, visitor))
      return false;
  }
  return true;
}

}  // namespace firmtouch::mesh
