#pragma once
// A segment against boxes, and down a tree of them. For the library's own translation units.

#include "firmtouch/hull/vertices.hpp"
#include "firmtouch/query/descent.hpp"

namespace firmtouch::hull {

/// The slabs of boxes as a segment meets them.
///
/// Box and origin are floats, so a plane's difference is off by one rounding, as are the step and
/// its inverse, and their product once more: 4 units of 2^-24 of the computed time. The exit is
/// stretched by four times that, and by an absolute 2^-100 for what vanishes below the range of
/// float. Boxes are padded by what a segment may move along an axis on which it is said to stand
/// still.
struct Slabs {
  float origin[3], rate[3];

  Slabs(math::Vec3 a_m, math::Vec3 b_m) {
    constexpr float kStill = 1e-30f, kFar = 1e30f;
    const math::Vec3 step_m = b_m - a_m;
    const float from[3] = {a_m.x, a_m.y, a_m.z}, step[3] = {step_m.x, step_m.y, step_m.z};
    bool is_near = true;
    for (uint32_t k = 0; k < 3; ++k) {
      const float size = step[k] < 0.0f ? -step[k] : step[k];
      const float off = from[k] < 0.0f ? -from[k] : from[k];
      is_near = is_near && size <= kFar && off <= kFar;
      origin[k] = from[k];
      rate[k] = 1.0f / (size > kStill ? step[k] : kStill);
    }
    for (uint32_t k = 0; k < 3 && !is_near; ++k)
      origin[k] = rate[k] = 0.0f;  // all are entered at 0
  }

  /// When the segment enters the box; more than `limit` where it does not until then.
  float enter(const Box& box, float limit) const {
    float first = 0.0f, last = limit;
    for (uint32_t k = 0; k < 3; ++k) {
      const float one = (box.low_m[k] - origin[k] - kPad_m) * rate[k];
      const float other = (box.high_m[k] - origin[k] + kPad_m) * rate[k];
      const float in = one < other ? one : other, out = one < other ? other : one;
      first = in > first ? in : first;
      last = out < last ? out : last;
    }
    const float latest = last * (1.0f + 0x1p-20f) + 0x1p-100f;
    return first <= latest ? first : kNever;
  }
  static constexpr float kNever = 2.0f, kPad_m = 4e-30f;
};

/// A tree whose levels are filled from the left. Its leaves stand from left to right in the last
/// level, then in the one above.
struct FilledTree {
  uint32_t nodes, inner, deepest;  // inner nodes; first node of the last level

  explicit FilledTree(uint32_t node_count) : nodes(node_count), inner(node_count / 2), deepest(1) {
    while (2 * deepest <= nodes) deepest *= 2;
    deepest -= 1;
  }
  bool is_leaf(uint32_t node) const { return node >= inner; }
  uint32_t leaf(uint32_t node) const {
    return node >= deepest ? node - deepest : node - inner + (nodes - deepest);
  }
  uint32_t node(uint32_t leaf) const {
    return leaf < nodes - deepest ? leaf + deepest : leaf - (nodes - deepest) + inner;
  }
};

/// A tree of boxes as query::descend() searches it: the leaves whose boxes `region` enters (Slabs
/// of a segment, a TriangleRegion, a point's neighbourhood), nearest first. Visitor::limit is the
/// largest key that is still of interest; Visitor::leaf(i) returns whether to go on.
/// kNested: each box lies within its parent's; else within `whole`.
template <bool kNested, class Region, class Visitor>
struct BoxSearch {
  struct Node {
    float key;
    uint32_t index;
    Box box;
  };
  static constexpr uint32_t kLeafWork = kLeafFaces;
  const NodeBox* boxes;
  const Box& whole;
  const Region& region;
  Visitor& visitor;
  FilledTree tree;

  float limit() const { return visitor.limit; }
  bool is_leaf(const Node& node) const { return tree.is_leaf(node.index); }
  bool leaf(const Node& node) { return visitor.leaf(tree.leaf(node.index)); }
  void set(Node& node, uint32_t index, const Box& outer) const {
    node.index = index;
    node.box = child_box(outer, boxes[index]);
    node.key = region.enter(node.box, visitor.limit);
  }
  Node root() const {
    Node node;
    set(node, 0, whole);
    return node;
  }
  void open(const Node& node, Node& one, Node& other) const {
    const Box& outer = kNested ? node.box : whole;
    set(one, 2 * node.index + 1, outer);
    set(other, 2 * node.index + 2, outer);
  }
};

template <bool kNested, class Region, class Visitor>
query::Descent<float> descend(core::Span<const NodeBox> boxes, const Box& whole,
                              const Region& region, query::Work& work, Visitor& visitor) {
  BoxSearch<kNested, Region, Visitor> search{boxes.data(), whole, region, visitor,
                                             FilledTree(boxes.size())};
  return query::descend<kMaxTreeDepth>(search, work);
}

}  // namespace firmtouch::hull
