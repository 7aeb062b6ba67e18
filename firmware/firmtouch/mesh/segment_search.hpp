#pragma once
// The search of a segment through the tree of boxes: in turn, looking ahead, and by blocks. For the
// library's own translation units.

#include "firmtouch/math/isa_segment.hpp"
#include "firmtouch/mesh/block.hpp"
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
    const bool is_later_first = key[1] < key[0];
    const Pending one = pending_of(key[0], node.side[0].child),
                  other = pending_of(key[1], node.side[1].child);
    const Pending nearer = is_later_first ? other : one, farther = is_later_first ? one : other;
    const Pending left = pending[count - 1];
    const bool any = key_of(nearer) != math::kNotEntered;
    pending[count] = farther;
    count += key_of(farther) != math::kNotEntered ? 1u : 0u;
    count -= any ? 0u : 1u;
    now = any ? nearer : left;
  }
}

/// search_in_turn() below the root, for a processor that runs ahead: while it waits to know which child is
/// nearer, it measures the boxes in both. A node's keys are those of its sides, measured when it was found;
/// the limit may have come nearer since.
/// `root_keys`: of the root's sides.
template <class Visitor>
[[gnu::noinline, gnu::flatten]] static bool search_ahead(const View& mesh,
                                                         const math::FamilySlabs& slabs_at,
                                                         uint64_t root_keys, math::Vec3 a_m,
                                                         math::Vec3 b_m, query::Budget budget,
                                                         Visitor& visitor, uint32_t& steps) {
  using math::Waiting;
  const math::FamilySlabs slabs = slabs_at;  // in registers
  const Node* const nodes = mesh.nodes().data();
  const auto boxes = [nodes](uint32_t child) {  // of a leaf those of the root
    const uint32_t inner = child & ~static_cast<uint32_t>(static_cast<int32_t>(child) >> 31);
    return reinterpret_cast<const uint32_t*>(nodes + inner);
  };
  Waiting now{pending_of(0, 0), root_keys};
  uint32_t visited = 1;
  const SegmentLanes segment(mesh.head(), a_m, b_m);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  Pending last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
  Waiting pending[kMaxDepth + 2];
  Waiting* left = pending;
  *left = {kEnd, 0};
  while (true) {
    while (true) {  // from inner node to inner node, without a branch
      const Node& node = nodes[child_of(now.what)];
      Waiting nearer{pending_of(static_cast<uint32_t>(now.keys), node.side[0].child), 0};
      Waiting farther{(now.keys >> 32 << 32) | node.side[1].child, 0};
      slabs.enter(boxes(node.side[0].child), boxes(node.side[1].child), nearer.keys, farther.keys);
      math::put_nearer_first(now.keys, nearer, farther);
      now = math::next_of(last, nearer, farther, left);
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
      if (!take_leaf_in_lanes(mesh, segment, child_of(now.what), visitor)) return true;
      last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
      now = *left--;
    }
  }
}

// What was taken of a block: the steps below its node, and whether the visitor wants more.
struct Taken {
  uint32_t steps;
  bool wants_more;
};

// Of a block's triangles those `asked` that are crossed, as a search in turn does.
template <class Visitor>
[[gnu::noinline]] static Taken take_block(const SegmentLanes& segment,
                                          const SegmentLanes::Passes& passes, uint32_t asked,
                                          const NodeBlock& block, const float* rows,
                                          const BlockKeys& keys, Visitor& visitor) {
  uint32_t steps = 0, prune = math::bits_of(visitor.limit) + 1;
  const auto corner = [&](uint32_t lane, uint32_t c) {
    return one_of_rows(rows + lane, 3 * c, block.of.count);
  };
  for (uint32_t i = 0; i < 2; ++i) {
    const uint32_t child = i ^ keys.is_later_first;
    steps += keys.child[child] < prune ? 1 : 0;
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t leaf = 2 * child + (k ^ keys.are_leaves_turned[child]);
      if (!(keys.leaf[leaf] < prune)) continue;
      ++steps;
      const uint32_t of_leaf = asked & (block.lanes >> (8 * leaf));
      if (of_leaf == 0) continue;
      if (!take_passed(segment, passes, of_leaf, block.of.first, corner, visitor))
        return {steps, false};
      prune = math::bits_of(visitor.limit) + 1;
    }
  }
  return {steps, true};
}

/// search_ahead() from what is made of the mesh (mesh/ahead.hpp), where no budget cuts it short: boxes wait for
/// no child's index, and a block is tested at once.
template <class Visitor>
[[gnu::noinline, gnu::flatten]] static bool search_lined(const View& mesh,
                                                         const math::FamilySlabs& slabs_at,
                                                         uint64_t root_keys, math::Vec3 a_m,
                                                         math::Vec3 b_m, Visitor& visitor,
                                                         uint32_t& steps) {
  using math::Waiting;
  const math::FamilySlabs slabs = slabs_at;  // in registers
  const Ahead& ahead = *mesh.ahead();
  const Node *const nodes = ahead.block_nodes, *const families = ahead.families;
  const auto enter = [&](uint32_t node, uint64_t& a_keys, uint64_t& b_keys) {
    const Node* const family = families + 2 * size_t{node};
    slabs.enter(family[0].side[0].box, family[1].side[0].box, a_keys, b_keys);
  };
  const SegmentLanes segment(mesh.head(), a_m, b_m);
  uint32_t visited = 1;
  Pending last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
  Waiting pending[kMaxDepth + 2];
  Waiting* left = pending;
  *left = {kEnd, 0};
  Waiting now{pending_of(0, 0), root_keys};
  while (true) {
    while (true) {  // from inner node to inner node, without a branch
      const Side* const sides = nodes[child_of(now.what)].side;
      fetch(ahead, sides[0].child);
      fetch(ahead, sides[1].child);
      Waiting nearer{pending_of(static_cast<uint32_t>(now.keys), sides[0].child), 0};
      Waiting farther{(now.keys >> 32 << 32) | sides[1].child, 0};
      enter(child_of(now.what), nearer.keys, farther.keys);
      math::put_nearer_first(now.keys, nearer, farther);
      now = math::next_of(last, nearer, farther, left);
      if (now.what > last) break;
      ++visited;
      if (child_of(now.what) >= kBlockBit) break;
    }
    while (true) {  // until it is an inner node
      if (now.what > last) {
        if (now.what == kEnd) {
          steps = visited;
          return true;
        }
        now = *left--;
        visited += now.what <= last ? 1 : 0;
        continue;
      }
      const uint32_t child = child_of(now.what);
      if (child < kBlockBit) break;
      bool wants_more = true;
      if (is_leaf(child)) {
        wants_more = take_lined_leaf(ahead, segment, child, visitor);
      } else {
        const uint32_t node = block_node(child);
        const NodeBlock& block = ahead.blocks[node];
        uint64_t a_keys, b_keys;
        enter(node, a_keys, b_keys);
        const Lined lined(ahead, block.of);
        const float* const rows = lined.row(ahead.corners, kRowsOfCorners);
        const SegmentLanes::Passes passes = segment.pass_rows(rows, block.of.count);
        const uint32_t asked = lined.asked() & ~passes.misses;
        const BlockKeys keys(block.lanes, now.keys, a_keys, b_keys);
        if (asked == 0) {
          visited += keys.steps(key_of(last) + 1);
        } else {
          const Taken taken = take_block(segment, passes, asked, block, rows, keys, visitor);
          visited += taken.steps;
          wants_more = taken.wants_more;
        }
      }
      if (!wants_more) {
        steps = visited;
        return true;
      }
      last = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
      now = *left--;
      visited += now.what <= last ? 1 : 0;
    }
  }
}

/// search_in_turn(), side by side.
template <class Visitor>
[[gnu::always_inline]] static inline bool search_side_by_side(const View& mesh, math::Vec3 a_m,
                                                              math::Vec3 b_m, query::Budget budget,
                                                              Visitor& visitor, uint32_t& steps) {
  math::FamilySlabs slabs;
  if (!slabs.begin(a_m, b_m, mesh.head().grid_low_m, mesh.head().cell_m) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  const uint64_t keys = slabs.enter_two(mesh.nodes()[0].side[0].box);
  if (keys == math::keys_of(math::kNotEntered, math::kNotEntered)) {
    steps = 1;
    return true;
  }
  const math::FamilySlabs kept = slabs;  // most segments end here: nothing of theirs is written
  return mesh.ahead() != nullptr && budget.steps == query::kUnlimited.steps
             ? search_lined(mesh, kept, keys, a_m, b_m, visitor, steps)
             : search_ahead(mesh, kept, keys, a_m, b_m, budget, visitor, steps);
}

template <class Visitor>
[[gnu::always_inline]] static inline bool search(const View& mesh, math::Vec3 a_m, math::Vec3 b_m,
                                                 query::Budget budget, Visitor& visitor,
                                                 uint32_t& steps) {
  if constexpr (math::kHasLanes)
    return search_side_by_side(mesh, a_m, b_m, budget, visitor, steps);
  else
    return search_in_turn(mesh, a_m, b_m, budget, visitor, steps);
}

}  // namespace firmtouch::mesh
