#pragma once
// The search for what a segment crosses, through the tree of boxes. For the library's own
// translation units.

#include "firmtouch/math/slabs.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/segment_frame.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/certificate.hpp"

namespace firmtouch::mesh {

// A pending box: the bits of the entry time, which order as it does, above the child. The highest
// value is the bottom of the stack and ends the search.
using PendingNode = uint64_t;
constexpr PendingNode kEnd = UINT64_MAX;
constexpr uint32_t child_of(PendingNode pending) { return static_cast<uint32_t>(pending); }
constexpr uint32_t key_of(PendingNode pending) { return static_cast<uint32_t>(pending >> 32); }
constexpr PendingNode pending_of(uint32_t key, uint32_t child) {
  return PendingNode{key} << 32 | child;
}

template <class Visitor>
static inline bool take_leaf(const View& mesh, const SegmentFrame& frame, uint32_t leaf,
                             Visitor& visitor) {
  const uint32_t first = leaf_first(leaf), end = first + leaf_count(leaf);
  for (uint32_t i = first; i < end; ++i) {
    const Triangle<uint32_t> t = mesh.triangle(i);
    const Crossing crossing = frame.crossing(mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]),
                                             mesh.vertex(t.corner[2]));
    if (crossing.direction != 0 && !visitor.take(crossing, i)) return false;
  }
  return true;
}

/// A segment in the frame of the boxes, and by how much its slabs are widened there: the line
/// between its turned ends errs by no more than both ends.
struct BoxSegment {
  math::Vec3 a_m, b_m;
  float slack_cells = math::kSlabSlackCells;

  BoxSegment(const View& mesh, math::Vec3 a, math::Vec3 b)
      : a_m(in_box_frame(mesh, a)), b_m(in_box_frame(mesh, b)) {
    if (mesh.box_frame() != nullptr) widen(mesh.head());
  }
  /// Not turned yet.
  BoxSegment(math::Vec3 a, math::Vec3 b) : a_m(a), b_m(b) {}
  /// Of turned ends.
  void widen(const Head& head) {
    const auto sum = [](math::Vec3 v) { return absolute(v.x) + absolute(v.y) + absolute(v.z); };
    slack_cells += (sum(a_m) + sum(b_m)) * (0x1p-21f / head.cell_m);
  }
};

/// Visits what the segment may cross, nearest first, until `visitor` has enough. Visitor::limit is
/// the largest t still of interest, at first 1. Visitor::take() returns whether to go on.
/// Result: false if the budget ended the search.
template <class Visitor>
static inline bool search(const View& mesh, math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                          Visitor& visitor, uint32_t& steps) {
  math::Slabs slabs;
  const BoxSegment in(mesh, a_m, b_m);
  if (!slabs.begin(math::on_grid(in.a_m, in.b_m, mesh.head().grid_low_m, mesh.head().cell_m),
                   in.slack_cells) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  slabs.set_limit(visitor.limit);
  uint32_t last_key = math::bits_of(visitor.limit);
  const uint32_t allowed = budget.work == 0 ? 1 : budget.work;
  SegmentFrame frame;
  bool has_frame = false;  // many segments reach no leaf
  const Node* nodes = mesh.nodes().data();
  PendingNode pending[kMaxDepth + 2];
  uint32_t count = 1;
  pending[0] = kEnd;
  PendingNode now = pending_of(0, 0);
  while (true) {
    if (key_of(now) > last_key) {
      if (now == kEnd) return true;
      now = pending[--count];
      continue;
    }
    if (steps == allowed) return false;
    ++steps;
    if (is_leaf(child_of(now))) {
      if (!has_frame) frame = SegmentFrame(mesh.head(), a_m, b_m);
      has_frame = true;
      if (!take_leaf(mesh, frame, child_of(now), visitor)) return true;
      if (math::bits_of(visitor.limit) != last_key) slabs.set_limit(visitor.limit);
      last_key = math::bits_of(visitor.limit);
      now = pending[--count];  // NOLINT(clang-analyzer-core*): kEnd is below all
      continue;
    }
    // Branchless, for no predictor learns it: next is the nearer box that is entered, else the
    // popped top of the stack.
    const Node& node = nodes[child_of(now)];
    uint32_t key[2];
    slabs.enter(reinterpret_cast<const uint32_t*>(&node), key);
    const bool is_later_first = key[1] < key[0];
    const PendingNode one = pending_of(key[0], node.side[0].child),
                      other = pending_of(key[1], node.side[1].child);
    const PendingNode nearer = is_later_first ? other : one, farther = is_later_first ? one : other;
    const PendingNode left = pending[count - 1];
    const bool any = key_of(nearer) != math::kNotEntered;
    pending[count] = farther;
    count += key_of(farther) != math::kNotEntered ? 1u : 0u;
    count -= any ? 0u : 1u;
    now = any ? nearer : left;
  }
}

}  // namespace firmtouch::mesh
