#pragma once
// A segment against the boxes and corners of a base hull, in integers. For the library's own
// translation units.

#include "firmtouch/hull/box_descent.hpp"

namespace firmtouch::hull {

/// The part of a segment within the base hull's box, prepared for comparison with stored bytes: a
/// box costs twelve integer loads and multiplications, a corner two. A negative test is certain: a
/// margin, computed in floats once a segment, covers every rounding.
///
/// Times run from 0 to kEnd along the part within the box. With c in 256ths of the box's side, a
/// plane at byte b is passed at b * rate from the segment's own base; the low planes are met first
/// on an axis along which the segment rises, the high planes (stored from the far side, so bytes
/// again) where it falls.
class BaseHullSegment {
 public:
  static constexpr int32_t kEnd = 1 << 20, kNever = INT32_MAX;

  /// Pre: both finite.
  BaseHullSegment(const BaseHull& base_hull, math::Vec3 a_m, math::Vec3 b_m);

  /// Whether it misses the box of the base hull.
  bool misses() const { return misses_; }

  /// When it enters a box, at the earliest; kNever where not until `limit`.
  int32_t enter(const NodeBox& box, int32_t limit) const {
    int32_t near = 0, far = limit;
    narrow(axis_[0], box, near, far);  // one by one: a loop would keep all in memory
    narrow(axis_[1], box, near, far);
    narrow(axis_[2], box, near, far);
    return near <= far ? near : kNever;
  }

  /// Latest time of a crossing whose computed time is `t`. Pre: t is 0 to 1.
  int32_t until(float t) const {
    const float end = (t - begin_) * times_ + 64.0f;
    return end < static_cast<float>(kEnd) ? static_cast<int32_t>(end > 0.0f ? end : 0.0f) : kEnd;
  }

  /// The corners of a leaf as they lie beside the line, in two halves of 16 bits: along the two
  /// shorter axes, in eights of the grid's steps.
  struct Corners {
    uint32_t beside[kMaxLeafCorners];
    // Bits for where it certainly lies beyond and before the line on either axis. A face whose
    // three corners share a bit is not crossed.
    uint32_t sides[kMaxLeafCorners];
  };
  /// Result: the bits that all of them share.
  uint32_t locate(const BaseHull& base_hull, const BaseHull::Leaf& leaf, Corners& corners) const {
    const Line line = line_;  // a copy, which the writing below cannot change
    const uint8_t *x = coordinates_ + at_[0], *y = coordinates_ + at_[1],
                  *along = coordinates_ + at_[2];
    const uint32_t count = leaf.corners.size(), made_count = made_count_, bytes = bytes_;
    uint32_t shared = UINT32_MAX;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t vertex = leaf.corners[i], at = vertex * bytes;
      const uint32_t beside =
          vertex < made_count
              ? line.beside(upper_half(x + at), upper_half(y + at), upper_half(along + at))
              : beside_of_kept(base_hull.kept(vertex));
      const uint32_t sides = line.sides(beside);
      corners.beside[i] = beside;
      corners.sides[i] = sides;
      shared &= sides;
    }
    return shared;
  }
  /// Whether the line certainly passes beside the face: all of it on one side, or edges on either
  /// hand.
  bool passes(const Corners& corners, BaseHullFace face) const {
    const uint32_t p = corner_at(face, 0), q = corner_at(face, 1), r = corner_at(face, 2);
    if ((corners.sides[p] & corners.sides[q] & corners.sides[r]) != 0) return true;
    const int32_t pu = lower(corners.beside[p]), pv = upper(corners.beside[p]);
    const int32_t qu = lower(corners.beside[q]), qv = upper(corners.beside[q]);
    const int32_t ru = lower(corners.beside[r]), rv = upper(corners.beside[r]);
    const int32_t pq = pu * qv - pv * qu, qr = qu * rv - qv * ru, rp = ru * pv - rv * pu;
    const int32_t sum =
        size_of(pu) + size_of(pv) + size_of(qu) + size_of(qv) + size_of(ru) + size_of(rv);
    const int32_t margin = lower(line_.margin), error = margin * (sum + 2 * margin);
    return (pq < -error || qr < -error || rp < -error) && (pq > error || qr > error || rp > error);
  }

 private:
  struct Axis {
    int32_t rate, near, far;
    uint32_t first, last;  // bytes of a NodeBox: of the plane met first, and last
  };

  static void narrow(const Axis& axis, const NodeBox& box, int32_t& near, int32_t& far) {
    const uint8_t* bytes = box.low;  // and high behind it
    const int32_t in = axis.near + bytes[axis.first] * axis.rate;
    const int32_t out = axis.far - bytes[axis.last] * axis.rate;
    near = in > near ? in : near;
    far = out < far ? out : far;
  }

  static uint32_t upper_half(const uint8_t* at) {
    uint16_t two;
    __builtin_memcpy(&two, at, 2);
    return two;
  }
  // Both halves of a word at once. Sums wrap on the way and end within 15 bits; what one half
  // borrows from the other is less than the margin counts.
  struct Line {
    uint32_t shear[2] = {}, from[2] = {};
    uint32_t margin = kBlind;

    uint32_t beside(uint32_t x, uint32_t y, uint32_t along) const {
      const uint32_t u = (x << kShearBits) - along * shear[0] - from[0];
      const uint32_t v = (y << kShearBits) - along * shear[1] - from[1];
      return u >> 16 | (v & 0xFFFF0000u);
    }
    uint32_t sides(uint32_t beside) const {
      return ((margin - beside) & kSigns) | ((beside + margin) & kSigns) >> 1;
    }
  };
  static constexpr uint32_t kSigns = 0x80008000u;
  static constexpr uint32_t kBlind = 0x40004000u;  // no corner is sure to lie anywhere
  static int32_t lower(uint32_t word) { return static_cast<int16_t>(word & 0xFFFFu); }
  static int32_t upper(uint32_t word) { return static_cast<int32_t>(word) >> 16; }
  static int32_t size_of(int32_t v) { return v < 0 ? -v : v; }
  uint32_t beside_of_kept(const BaseHullVertex& kept) const;
  void open_axes(const BaseHullHead& head, const float (&from_m)[3], const float (&to_m)[3],
                 const float (&error_m)[3]);
  void open_line(const float (&from_m)[3], const float (&step_m)[3], const float (&error_m)[3]);

  static constexpr uint32_t kShearBits = 13;

  bool misses_ = false;
  Axis axis_[3];
  float begin_ = 0.0f, times_ = 0.0f;  // t where the part begins; of t, times kEnd
  const uint8_t* coordinates_;         // upper halves of the made vertices
  uint32_t made_count_, bytes_, at_[3], longest_ = 0;
  Line line_;
  float grid_low_m_[3], steps_per_m_ = 0.0f;
};

/// The tree of a base hull along a segment, as query::descend() searches it. Visitor::limit is the
/// largest time that is still of interest; Visitor::face(leaf, n) takes each face that the segment
/// may cross, and returns whether to go on.
template <class Visitor>
struct BaseHullSearch {
  struct Node {
    int32_t key;
    uint32_t index;
  };
  static constexpr uint32_t kLeafWork = kLeafFaces;
  const BaseHull& base_hull;
  const BaseHullSegment& segment;
  Visitor& visitor;
  const NodeBox* boxes;
  FilledTree tree;

  int32_t limit() const { return visitor.limit; }
  Node root() const { return {0, 0}; }
  bool is_leaf(const Node& node) const { return tree.is_leaf(node.index); }
  void open(const Node& node, Node& one, Node& other) const {
    const uint32_t left = 2 * node.index + 1;
    one = {segment.enter(boxes[left], visitor.limit), left};
    other = {segment.enter(boxes[left + 1], visitor.limit), left + 1};
  }
  bool leaf(const Node& node) {
    const BaseHull::Leaf leaf = base_hull.leaf(tree.leaf(node.index));
    BaseHullSegment::Corners corners;
    if (segment.locate(base_hull, leaf, corners) != 0) return true;
    for (uint32_t n = 0; n < leaf.faces.size(); ++n)
      if (!segment.passes(corners, leaf.faces[n]) && !visitor.face(leaf, n)) return false;
    return true;
  }
};

/// Result: whether the search came to its end within the budget.
template <class Visitor>
bool descend(const BaseHull& base_hull, const BaseHullSegment& segment, query::Work& work,
             Visitor& visitor) {
  if (segment.misses()) return true;
  BaseHullSearch<Visitor> search{base_hull, segment, visitor, base_hull.boxes().data(),
                                 FilledTree(base_hull.boxes().size())};
  return query::descend<kMaxTreeDepth>(search, work).is_done;
}

}  // namespace firmtouch::hull
