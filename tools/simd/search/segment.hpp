#pragma once
// The search for what a segment crosses, eight triangles at once. Compiled once per level.

#include "firmtouch/mesh/segment_search.hpp"
#include "simd/search/nearest.hpp"
#include "simd/search/segment_lanes.hpp"
#include "simd/search/slabs.hpp"

namespace firmtouch::simd {

using mesh::child_of;
using mesh::kEnd;
using mesh::key_of;
using mesh::pending_of;
using mesh::PendingNode;

// Of a block: the visits below its node, and whether the visitor wants more.
struct Taken {
  uint32_t steps;
  bool wants_more;
};

// Gives the visitor the crossings of the lanes `of`, in the order of the scalar search. flatten: a
// corner that is passed by value waits for the stores of its floats (14 % of a part's time).
template <class Visitor>
[[gnu::noinline, gnu::flatten]] static Taken take_crossings(
    const SegmentLanes& segment, const SegmentLanes::Passes& passes, uint32_t of,
    const NodeBlock& block, const float* arrays, const BlockKeys& keys, Visitor& visitor) {
  uint32_t steps = 0, prune = math::bits_of(visitor.limit) + 1;
  const auto corner = [&](uint32_t lane, uint32_t c) {
    return vector_of(arrays + lane, 3 * c, block.of.count);
  };
  for (uint32_t i = 0; i < 2; ++i) {
    const uint32_t child = i ^ keys.is_later_first;
    steps += keys.child[child] < prune ? 1 : 0;
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t leaf = 2 * child + (k ^ keys.are_leaves_swapped[child]);
      if (!(keys.leaf[leaf] < prune)) continue;
      ++steps;
      const uint32_t of_leaf = of & (block.lanes >> (8 * leaf));
      if (of_leaf == 0) continue;
      if (!take_passed(segment, passes, of_leaf, block.of.first, corner, visitor))
        return {steps, false};
      prune = math::bits_of(visitor.limit) + 1;
    }
  }
  return {steps, true};
}

// Prefetches both cache lines of a node.
[[gnu::always_inline]] static inline void fetch(const SegmentNode& node) {
  __builtin_prefetch(node.planes);
  __builtin_prefetch(node.planes + 64 / sizeof(float));
}

/// mesh::search() below the root without budget, by blocks: the same visits and crossings.
/// `root_keys`: of the root's sides. The ends by reference, for the same reason as above.
template <class Visitor>
[[gnu::noinline, gnu::flatten]] static bool search_blocks(const View& mesh, const WideTree& tree,
                                                          const FourSlabs& slabs_at,
                                                          uint64_t root_keys, const math::Vec3& a_m,
                                                          const math::Vec3& b_m, Visitor& visitor,
                                                          uint32_t& steps) {
  const FourSlabs slabs = slabs_at;  // in registers
  const SegmentNode* const nodes = tree.segment_nodes;
  const SegmentLanes segment(mesh.head(), a_m, b_m);
  uint32_t visited = 1;
  PendingNode cutoff = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
  Entry pending[kMaxDepth + 2];
  Entry* top = pending;
  *top = {kEnd, 0};
  Entry now{pending_of(0, 0), root_keys};
  while (true) {
    while (true) {  // from inner node to inner node, branchless
      const SegmentNode& node = nodes[child_of(now.key)];
      fetch(nodes[node.below.fetched[0]]);
      fetch(nodes[node.below.fetched[1]]);
      Entry nearer{pending_of(static_cast<uint32_t>(now.keys), node.below.child[0]), 0};
      Entry farther{(now.keys >> 32 << 32) | node.below.child[1], 0};
      slabs.enter(node, nearer.keys, farther.keys);
      put_nearer_first(now.keys, nearer, farther);
      now = next_of(cutoff, nearer, farther, top);
      if (now.key > cutoff) break;
      ++visited;
      if (child_of(now.key) >= kBlockBit) break;
    }
    while (true) {  // until an inner node is next
      if (now.key > cutoff) {
        if (now.key == kEnd) {
          steps = visited;
          return true;
        }
        now = *top--;
        visited += now.key <= cutoff ? 1 : 0;
        continue;
      }
      const uint32_t child = child_of(now.key);
      if (child < kBlockBit) break;
      bool wants_more = true;
      if (is_leaf(child)) {
        wants_more = take_wide_leaf(tree, segment, child, visitor);
      } else {
        const SegmentNode& node = nodes[block_node(child)];
        const NodeBlock block = node.block;
        uint64_t a_keys, b_keys;
        slabs.enter(node, a_keys, b_keys);
        const BlockTriangles triangles(tree, block.of);
        const float* const arrays = triangles.begin(tree.corners, kCornerArrays);
        const SegmentLanes::Passes passes = segment.passes(arrays, block.of.count);
        const uint32_t crossed = triangles.lanes() & ~passes.misses;
        const BlockKeys keys(block.lanes, now.keys, a_keys, b_keys);
        if (crossed == 0) {
          visited += keys.steps(key_of(cutoff) + 1);
        } else {
          const Taken taken =
              take_crossings(segment, passes, crossed, block, arrays, keys, visitor);
          visited += taken.steps;
          wants_more = taken.wants_more;
        }
      }
      if (!wants_more) {
        steps = visited;
        return true;
      }
      cutoff = pending_of(math::bits_of(visitor.limit), UINT32_MAX);
      now = *top--;
      visited += now.key <= cutoff ? 1 : 0;
    }
  }
}

// noinline: rare, and its stack would be the caller's.
template <class Visitor>
[[gnu::noinline]] static bool search_within_budget(const View& mesh, math::Vec3 a_m, math::Vec3 b_m,
                                                   query::Budget budget, Visitor& visitor,
                                                   uint32_t& steps) {
  return mesh::search(mesh, a_m, b_m, budget, visitor, steps);
}

/// mesh::search().
template <class Visitor>
[[gnu::always_inline]] static inline bool search_segment(const View& mesh, const WideTree& tree,
                                                         math::Vec3 a_m, math::Vec3 b_m,
                                                         query::Budget budget, Visitor& visitor,
                                                         uint32_t& steps) {
  if (budget.work != query::kUnlimited.work)
    return search_within_budget(mesh, a_m, b_m, budget, visitor, steps);
  FourSlabs slabs;
  mesh::BoxSegment in(a_m, b_m);
  // Inlined: a point that a call returns waits for the stores of its floats (half the time of the
  // segments of a part that stands askew).
  if (const mesh::BoxFrame* const frame = mesh.box_frame()) {
    in.a_m = in_frame(*frame, a_m), in.b_m = in_frame(*frame, b_m);
    in.widen(mesh.head());
  }
  if (!slabs.begin(in.a_m, in.b_m, mesh.head().grid_low_m, mesh.head().cell_m, in.slack_cells) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  uint64_t keys, again;
  slabs.enter(tree.segment_nodes[mesh.nodes().size()], keys, again);
  if (keys == keys_of(math::kNotEntered, math::kNotEntered)) {
    steps = 1;
    return true;
  }
  const FourSlabs kept = slabs;  // most segments end above: nothing of theirs is stored
  return search_blocks(mesh, tree, kept, keys, a_m, b_m, visitor, steps);
}

}  // namespace firmtouch::simd
