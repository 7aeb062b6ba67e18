#pragma once
// The search for the nearest triangle, by blocks of eight. Compiled once per level.

#include "firmtouch/mesh/nearest_search.hpp"
#include "simd/search/block.hpp"
#include "simd/search/boxes.hpp"
#include "simd/search/entries.hpp"

namespace firmtouch::simd {
namespace {

using math::Vec3;
using mesh::kMaxDepth;
using mesh::prune_key;
using mesh::Search;
using mesh::View;

/// Prefetches what is below a child, its boxes or its block: most of a search waits for the second
/// cache. Of a leaf, which is rare here, it prefetches any line.
[[gnu::always_inline]] inline void fetch(const WideTree& tree, uint32_t child) {
  __builtin_prefetch(tree.children + 2 * size_t{child & (kMaxWideTriangles - 1)});
}

// The triangles of a block that are nearer.
[[gnu::always_inline, maybe_unused]] inline uint32_t nearer_of(const Feet& feet, const Block& block,
                                                               float min2_m2) {
  return bits_of(less(feet.distance2_m2, all_of(min2_m2))) & ((1u << block.count) - 1u);
}

// Beyond this squared distance a triangle is of no interest.
template <bool kRivals>
[[gnu::always_inline]] inline float limit_of(const Search& search) {
  return kRivals ? search.rivals.limit2_m2(search.best.distance2_m2) : search.best.distance2_m2;
}
// Of a leaf without a block. Result: whether one of its triangles is the nearest.
inline bool take_leaf_rivals(const BlockTriangles& leaf, Vec3 p_m, uint32_t slot, Search& search) {
  return take_rivals(feet_on(leaf, p_m), CornerArrays(leaf), leaf.lanes(), leaf.first, slot,
                     search.best, search.rivals);
}

// A tree of more nodes does not fit the second cache.
constexpr uint32_t kMaxNodesNear = 16384;

// Prefetches the corners of the block of `child`, the next node; if it has none, those of `node`,
// which are in the cache.
[[gnu::always_inline, maybe_unused]] inline void fetch_corners(const WideTree& tree, uint32_t child,
                                                               uint32_t node) {
  const bool has_block = (child & ~(kBlockBit - 1)) == kBlockBit;
  const Block block = tree.block(chosen(has_block, block_node(child), node)).of;
  const float* const first = tree.corners + size_t{kCornerArrays} * block.first;
  for (size_t i = 0; i < size_t{kCornerArrays} * block.count; i += 64 / sizeof(float))
    __builtin_prefetch(first + i);
}

// A leaf. Result: whether a triangle is nearer.
template <bool kRivals>
inline bool take_leaf_of(const WideTree& tree, uint32_t child, uint32_t slot, Search& search) {
  const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
  const BlockTriangles triangles(tree, child);
  const float before2_m2 = search.best.distance2_m2;
  if constexpr (kRivals)
    return take_leaf_rivals(triangles, p_m, slot, search);
  else
    return measure_wide_leaf(triangles, p_m, slot, before2_m2, search.best) < before2_m2;
}

// A block in which a triangle is nearer. Result: visits below its node.
template <bool kRivals>
inline uint32_t take_block_of(const WideTree& tree, const Feet& feet, const NodeBlock& block,
                              const BlockKeys& keys, const NearBound& bound, const Side* sides,
                              uint32_t node, uint32_t& prune, Search& search) {
  if constexpr (kRivals)
    return take_block(feet, CornerArrays(BlockTriangles(tree, block.of)), block, keys, bound, sides,
                      node, prune, search.best, search.rivals);
  else
    return take_block(feet, block, keys, bound, sides, node, prune, search.best);
}

/// mesh::search_nearest() of a cold query without budget: the same leaves in the same order, the
/// same visits. Instead of waiting for the nearer of two children it measures the boxes in both,
/// and selects by conditional moves. The keys in an entry are those of its node's sides. A block is
/// measured at once.
/// Pre: search.start == kNowhere; search.budget is not reached. Result: visits.
template <bool kRivals>
[[gnu::noinline, gnu::flatten, maybe_unused]] uint32_t search_cold(const View& mesh,
                                                                   const WideTree& tree,
                                                                   const NearBound& bound_at,
                                                                   Search& search) {
  const NearBound bound = bound_at;
  const Node* const children = tree.children;
  const auto sibling_keys = [&](uint64_t node, uint64_t& a_keys, uint64_t& b_keys) {
    const Node* const siblings = children + 2 * node;
    sibling_distances2(siblings[0].side[0].box, siblings[1].side[0].box, bound.point, a_keys,
                       b_keys);
  };
  const uint64_t root = 2 * uint64_t{mesh.nodes().size()};
  const bool is_large = mesh.nodes().size() > kMaxNodesNear;
  // The largest entry key that is not pruned: the box key above the slot.
  uint64_t cutoff = (uint64_t{prune_key(bound, search)} << 32) - 1;
  ChildEntry pending[kMaxDepth + 2];
  ChildEntry* top = pending;
  *top = {UINT64_MAX, 0, 0};
  ChildEntry now{root, 0, 0};
  uint64_t again;
  const uint32_t* const boxes = children[root].side[0].box;
  sibling_distances2(boxes, boxes, bound.point, now.keys, again);
  if constexpr (kRivals) search.begin_rivals(mesh);
  uint32_t steps = 1;
  while (true) {
    while (true) {  // from inner node to inner node, branchless
      const Side* const sides = children[low_half(now.key)].side;
      ChildEntry nearer{(now.keys << 32) | (2 * now.child), 0, sides[0].child};
      ChildEntry farther{(now.keys >> 32 << 32) | (2 * now.child + 1), 0, sides[1].child};
      fetch(tree, sides[0].child);
      fetch(tree, sides[1].child);
      sibling_keys(now.child, nearer.keys, farther.keys);
      order(nearer, farther);
      now = next_of(cutoff, nearer, farther, top);
      if (now.key > cutoff) break;
      ++steps;
      if (static_cast<uint32_t>(now.child) >= kBlockBit) break;
    }
    while (true) {  // until an inner node is next
      if (now.key > cutoff) {
        if (now.key == UINT64_MAX) return steps;
        now = *top--;
        steps += now.key <= cutoff ? 1 : 0;
        continue;
      }
      const uint32_t child = static_cast<uint32_t>(now.child), slot = low_half(now.key);
      if (child < kBlockBit) break;
      const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
      Best& best = search.best;
      const float before2_m2 = best.distance2_m2;
      if (!is_leaf(child)) {
        const uint32_t node = block_node(child);
        const NodeBlock block = tree.block(node);
        uint64_t a_keys, b_keys;
        if (is_large) fetch_corners(tree, static_cast<uint32_t>(top->child), node);
        sibling_keys(node, a_keys, b_keys);
        const Feet feet = feet_on(BlockTriangles(tree, block.of), p_m);
        uint32_t prune = high_half(cutoff + 1);
        const BlockKeys keys(block.lanes, now.keys, a_keys, b_keys);
        if (nearer_of(feet, block.of, limit_of<kRivals>(search)) == 0) {
          steps += keys.steps(prune);
        } else {
          steps += take_block_of<kRivals>(tree, feet, block, keys, bound, children[slot].side, node,
                                          prune, search);
          cutoff = (uint64_t{prune} << 32) - 1;
        }
      } else if (take_leaf_of<kRivals>(tree, child, slot, search)) {
        cutoff = (uint64_t{prune_key(bound, search)} << 32) - 1;
      }
      // The answer reads this direction after the search.
      if (best.distance2_m2 < before2_m2)
        __builtin_prefetch(tree.directions + size_t{kFeatures} * best.triangle +
                           static_cast<uint32_t>(best.feature));
      now = *top--;
      steps += now.key <= cutoff ? 1 : 0;
    }
  }
}

// Measures a block in which a triangle may be nearer. Result: visits below the node. noinline:
// rare, and inlined it takes registers from the loop.
template <bool kRivals>
[[gnu::noinline, maybe_unused]] uint32_t measure_block(const WideTree& tree, uint32_t node,
                                                       const NearBound& bound, uint32_t& prune,
                                                       Search& search) {
  const Side* const sides = tree.block_nodes[node].side;
  const Node* const siblings = tree.children + 2 * uint64_t{node};
  uint32_t key0, key1, child0, child1;
  bound.keys(sides, key0, key1, child0, child1);
  uint64_t a_keys, b_keys;
  sibling_distances2(siblings[0].side[0].box, siblings[1].side[0].box, bound.point, a_keys, b_keys);
  const NodeBlock block = tree.block(node);
  const BlockKeys keys(block.lanes, keys_of(key0, key1), a_keys, b_keys);
  const Feet feet =
      feet_on(BlockTriangles(tree, block.of), {search.p_m.x, search.p_m.y, search.p_m.z});
  if (nearer_of(feet, block.of, limit_of<kRivals>(search)) == 0) return keys.steps(prune);
  if constexpr (kRivals)
    return take_block(feet, CornerArrays(BlockTriangles(tree, block.of)), block, keys, bound, sides,
                      node, prune, search.best, search.rivals);
  return take_block(feet, block, keys, bound, sides, node, prune, search.best);
}

// mesh::ascend() without branches on the leaf's distance: the processor goes on while it waits for
// it.
inline void ascend(const View& mesh, const Side* sides, const NearBound& bound, uint32_t prune,
                   uint32_t& left, mesh::Pending*& top, Search& search) {
  const uint32_t* const parents = mesh.parents().data();
  const float leaf_m = math::square_root(math::smaller(search.best.distance2_m2, search.band2_m2)) *
                       (1.0f + 0x1p-22f);
  const float reach_m = leaf_m + search.safe_subtree_margin_m;
  const uint32_t beyond = bound.prune_key(reach_m * reach_m);
  uint32_t slot = search.start;
  uint32_t stop = leaf_m <= search.safe_subtree_m ? search.safe_subtree : 0;
  uint32_t safe_subtree = slot >> 1;
  for (;; --left) {
    const uint32_t sibling = slot ^ 1u, index = slot >> 1;
    const uint32_t key = bound.key(sides[sibling].box);
    safe_subtree = key < beyond ? index : safe_subtree;
    *top = {key, sibling};
    top += key < prune ? 1 : 0;
    if (index <= stop) {
      if (index == 0) {
        search.safe_subtree = safe_subtree;
        search.safe_subtree_m = reach_m * (1.0f - 0x1p-22f);
      }
      if (index == 0 || index == stop) {
        --left;
        return;
      }
      stop = 0;
    }
    slot = mesh::slot_of(parents[index]);
  }
}

/// mesh::search_nearest() of a warm query without budget: the same nodes in the same order, the
/// same visits. Usually the prisms of a block already exclude all of its triangles.
/// Pre: search.start != kNowhere; search.budget is not reached. Result: visits.
template <bool kRivals>
[[gnu::noinline, gnu::flatten, maybe_unused]] uint32_t search_warm(const View& mesh,
                                                                   const WideTree& tree,
                                                                   const NearBound& bound_at,
                                                                   uint32_t triangle_low,
                                                                   Search& search) {
  const NearBound bound = bound_at;  // in registers
  const Side* const sides = tree.block_nodes->side;
  const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
  const float slack_m2 = search.slack_m2;
  Best& best = search.best;
  const BlockTriangles last(tree, sides[search.start].child);
  if constexpr (kRivals) search.begin_rivals(mesh);
  const auto limit2_of = [&](float distance2_m2) {
    return kRivals ? search.rivals.limit2_m2(distance2_m2) : distance2_m2;
  };
  const Begun begun = begin_at(last, p_m, search.start, triangle_low, slack_m2, limit2_of, best);
  if (!begun.is_taken) {
    if constexpr (kRivals)
      take_leaf_rivals(last, p_m, search.start, search);
    else
      take_nearest(feet_on(last, p_m), last.lanes(), last.first, search.start, FLT_MAX, best);
  }
  uint32_t prune = prune_key(bound, search), left = UINT32_MAX - 1, slot;
  float limit2_m2 = prism_limit2(limit_of<kRivals>(search), slack_m2);
  mesh::Pending pending[mesh::kCapacity];
  mesh::Pending* top = pending;
  ascend(mesh, sides, bound, prune, left, top, search);
  while (mesh::take_last(top, pending, prune, slot)) {
    uint32_t child = sides[slot].child;
    for (--left; child < kBlockBit; --left)
      if (!mesh::enter(sides, bound, prune, child, slot, top)) break;
    if (child < kBlockBit) continue;
    if (!is_leaf(child)) {
      const uint32_t node = block_node(child);
      const NodeBlock block = tree.block(node);
      const BlockTriangles triangles(tree, block.of);
      if (may_be_nearer(triangles, p_m, limit2_m2) == 0) {
        const uint32_t* const below = tree.children[2 * uint64_t{node}].side[0].box;
        left -= static_cast<uint32_t>(__builtin_popcount(
            boxes_below(sides[2 * node].box, below, bound.point, prune) & block.boxes));
        continue;
      }
      left -= measure_block<kRivals>(tree, node, bound_at, prune, search);
    } else if constexpr (kRivals) {
      const BlockTriangles leaf(tree, child);
      if (leaf.of.first == begun.clear || may_be_nearer(leaf, p_m, limit2_m2) == 0 ||
          !take_leaf_rivals(leaf, p_m, slot, search))
        continue;
      prune = prune_key(bound, search);
    } else {
      const float before2_m2 = best.distance2_m2;
      if (wide_leaf_block(child).first == begun.clear ||
          !(measure_near_leaf(BlockTriangles(tree, child), p_m, slot, before2_m2, limit2_m2, best) <
            before2_m2))
        continue;
      prune = prune_key(bound, search);
    }
    limit2_m2 = prism_limit2(limit_of<kRivals>(search), slack_m2);
  }
  return UINT32_MAX - left;
}

}  // namespace
}  // namespace firmtouch::simd
