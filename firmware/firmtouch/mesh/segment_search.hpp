#pragma once
// The search of a segment through the tree of boxes, in turn and looking ahead. For the library's own
// translation units.

#include "firmtouch/math/isa_segment.hpp"
#include "firmtouch/mesh/segment_lanes.hpp"

namespace firmtouch::mesh {

// What is still to be visited: the bits of the entry, which order as the entry does, above the
// child. The greatest stands below all others and ends the search.
using Pending = uint64_t;
constexpr Pending kEnd = UINT64_MAX;
constexpr uint32_t child_of(Pending pending) { return static_cast<uint32_t>(pending); }
constexpr uint32_t key_of(Pending pending) { return static_cast<uint32_t>(pending >> 32); }
constexpr Pending pending_of(uint32_t key, uint32_t child) { return Pending{key} << 32 | child; }

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

/// Visits what the segment may cross, nearest first, until `visitor` has enough. Visitor::limit is
/// the largest t that is still of interest, at first 1, Visitor::take() answers whether it wants
/// more.
/// Result: whether the search came to its end.
template <class Visitor>
static inline bool search_in_turn(const View& mesh, math::Vec3 a_m, math::Vec3 b_m,
                                  query::Budget budget, Visitor& visitor, uint32_t& steps) {
  math::PortableSlabs slabs;
  if (!slabs.begin(math::on_grid(a_m, b_m, mesh.head().grid_low_m, mesh.head().cell_m)) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  slabs.set_limit(visitor.limit);
  uint32_t last_key = math::bits_of(visitor.limit);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  SegmentFrame frame;
  bool has_frame = false;  // many segments reach no leaf
  const Node* nodes = mesh.nodes().data();
  Pending pending[kMaxDepth + 2];
  uint32_t count = 1;
  pending[0] = kEnd;
  Pending now = pending_of(0, 0);
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
      now = pending[--count];
      continue;
    }
    // Without branches, which could not be foretold: the nearer of what is entered is next, else
    // what was left last.
    const Node& node = nodes[child_of(now)];
    uint32_t key[2];
    slabs.enter(reinterpret_cast<const uint32_t*>(&node), key);
    const Pending one = pending_of(key[0], node.side[0].child),
                  other = pending_of(key[1], node.side[1].child);
    const Pending nearer = one < other ? one : other, farther = one < other ? other : one;
    const Pending left = pending[count - 1];
    const bool any = key_of(nearer) != math::kNotEntered;
    pending[count] = farther;
    count += key_of(farther) != math::kNotEntered ? 1u : 0u;
    count -= any ? 0u : 1u;
    now = any ? nearer : left;
  }
}

/// The same search, for a processor that runs ahead: while it waits to know which child is nearer,
/// it measures the boxes in both. A node's keys are those of its sides, measured when it was found;
/// the limit may have come nearer since.
/// `kIsLined`: from what is made of the mesh (mesh/ahead.hpp), where boxes wait for no child's index.
template <bool kIsLined, class Visitor>
[[gnu::always_inline]] static inline bool search_ahead(const View& mesh, math::Vec3 a_m,
                                                       math::Vec3 b_m, query::Budget budget,
                                                       Visitor& visitor, uint32_t& steps) {
  using math::Waiting;
  math::FamilySlabs slabs;
  if (!slabs.begin(a_m, b_m, mesh.head().grid_low_m, mesh.head().cell_m) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  const Node* const nodes = kIsLined ? mesh.ahead()->nodes : mesh.nodes().data();
  const Node* const families = kIsLined ? mesh.ahead()->families : nullptr;
  const auto boxes = [nodes](uint32_t child) {  // of a leaf those of the root
    const uint32_t inner = child & ~static_cast<uint32_t>(static_cast<int32_t>(child) >> 31);
    return reinterpret_cast<const uint32_t*>(nodes + inner);
  };
  constexpr uint64_t kNone = math::keys_of(math::kNotEntered, math::kNotEntered);
  Waiting now{pending_of(0, 0), slabs.enter_two(boxes(0))};
  uint32_t visited = 1;
  if (now.keys == kNone) {
    steps = visited;
    return true;
  }
  const SegmentLanes segment(mesh.head(), a_m, b_m);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  Pending last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
  Waiting pending[kMaxDepth + 2];
  Waiting* left = pending;
  *left = {kEnd, kNone};
  while (true) {
    while (true) {  // from inner node to inner node, without a branch
      const Node& node = nodes[child_of(now.what)];
      Waiting nearer{pending_of(static_cast<uint32_t>(now.keys), node.side[0].child), 0};
      Waiting farther{(now.keys >> 32 << 32) | node.side[1].child, 0};
      if constexpr (kIsLined) {
        const Node* const family = families + 2 * size_t{child_of(now.what)};
        slabs.enter(reinterpret_cast<const uint32_t*>(family),
                    reinterpret_cast<const uint32_t*>(family + 1), nearer.keys, farther.keys);
      } else {
        slabs.enter(boxes(node.side[0].child), boxes(node.side[1].child), nearer.keys,
                    farther.keys);
      }
      math::put_in_order(nearer, farther);
      const Waiting left_last = *left;
      left[1] = farther;
      left += farther.what <= last ? 1 : 0;
      left -= nearer.what <= last ? 0 : 1;
      math::replace_beyond(last, nearer, left_last);
      now = nearer;
      if (now.what > last || is_leaf(child_of(now.what)) || visited == allowed) break;
      ++visited;
    }
    while (true) {  // until it is an inner node
      steps = visited;
      if (now.what > last) {
        if (now.what == kEnd) return true;
        now = *left--;
        continue;
      }
      if (visited == allowed) return false;
      steps = ++visited;
      if (!is_leaf(child_of(now.what))) break;
      if (!take_leaf_in_lanes<kIsLined>(mesh, segment, child_of(now.what), visitor)) return true;
      last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
      now = *left--;
    }
  }
}

// Whether a segment, which reads a few leaves, gains by what is made of the mesh: of more nodes that
// does not stay near the processor, and only leaves of more than four triangles make up for it.
inline bool gains_ahead(const View& mesh) {
  constexpr uint32_t kMostNodes = 8192;
  const uint32_t nodes = mesh.nodes().size();
  return mesh.ahead() != nullptr && (nodes <= kMostNodes || mesh.head().triangle_count / 4 > nodes);
}

template <class Visitor>
[[gnu::always_inline]] static inline bool search(const View& mesh, math::Vec3 a_m, math::Vec3 b_m,
                                                 query::Budget budget, Visitor& visitor,
                                                 uint32_t& steps) {
  if constexpr (math::kHasLanes)
    return gains_ahead(mesh) ? search_ahead<true>(mesh, a_m, b_m, budget, visitor, steps)
                             : search_ahead<false>(mesh, a_m, b_m, budget, visitor, steps);
  else
    return search_in_turn(mesh, a_m, b_m, budget, visitor, steps);
}

}  // namespace firmtouch::mesh
