#pragma once
// The search for the nearest triangle on a processor that runs ahead and has vector instructions. For
// closest_point.cpp alone.

#include "firmtouch/math/isa_ahead.hpp"
#include "firmtouch/mesh/block.hpp"
#include "firmtouch/mesh/nearest_search.hpp"

namespace firmtouch::mesh {
namespace {

// Those of a block's triangles that are nearer.
[[gnu::always_inline, maybe_unused]] inline uint32_t nearer_of(const Feet<math::FloatWide>& feet,
                                                               const Block& block, float min2_m2) {
  return math::lanes_of(math::less(feet.distance2_m2, lanes::all_of<math::FloatWide>(min2_m2))) &
         ((1u << block.count) - 1u);
}

// Of more nodes a mesh does not stay in the second cache.
constexpr uint32_t kMaxNodesNear = 16384;

// Has the processor fetch the corners of `child`, the next to be read: of its block, or where it has none
// of that of `node`, which are there.
[[gnu::always_inline, maybe_unused]] inline void fetch_corners(const Ahead& ahead, uint32_t child,
                                                               uint32_t node) {
  const bool has_block = (child & ~(kBlockBit - 1)) == kBlockBit;
  const Block& block = ahead.blocks[chosen(has_block, block_node(child), node)].of;
  const float* const first = ahead.corners + size_t{kRowsOfCorners} * block.first;
  for (size_t i = 0; i < size_t{kRowsOfCorners} * block.count; i += 64 / sizeof(float))
    __builtin_prefetch(first + i);
}

/// search_nearest() of a query that knows no leaf to begin with and that no budget cuts short: the
/// same leaves in the same order, the same steps. While the processor waits to know which of two
/// children is nearer it measures the boxes in both; who is next is moved under a condition, not
/// jumped to. A node's keys are those of its sides, measured when it was found; what `last` is may
/// have come nearer since. A block is measured at once.
/// Pre: search.start == kNowhere; search.budget is not reached.
[[gnu::noinline, gnu::flatten, maybe_unused]] void search_ahead(const View& mesh,
                                                                const NearBound& bound_at,
                                                                Search& search) {
  using math::WaitingChild;
  const NearBound bound = bound_at;
  const Ahead& ahead = *mesh.ahead();
  const Node* const families = ahead.families;
  const auto family_keys = [&](uint64_t node, uint64_t& a_keys, uint64_t& b_keys) {
    const Node* const family = families + 2 * node;
    math::family_distances2(family[0].side[0].box, family[1].side[0].box, bound.point, a_keys,
                            b_keys);
  };
  const uint64_t root = 2 * uint64_t{mesh.nodes().size()};
  const bool is_large = mesh.nodes().size() > kMaxNodesNear;
  // The last of all that is below the key to prune by: the key above the place.
  uint64_t last = (uint64_t{prune_key(bound, search)} << 32) - 1;
  WaitingChild pending[kMaxDepth + 2];
  WaitingChild* left = pending;
  *left = {UINT64_MAX, 0, 0};
  WaitingChild now{root, 0, 0};
  uint64_t again;
  const uint32_t* const boxes = families[root].side[0].box;
  math::family_distances2(boxes, boxes, bound.point, now.keys, again);
  search.complete = true;
  uint32_t steps = 1;
  while (true) {
    while (true) {  // from inner node to inner node, without a branch
      const Side* const sides = families[low_half(now.what)].side;
      WaitingChild nearer{(now.keys << 32) | (2 * now.child), 0, sides[0].child};
      WaitingChild farther{(now.keys >> 32 << 32) | (2 * now.child + 1), 0, sides[1].child};
      fetch(ahead, sides[0].child);
      fetch(ahead, sides[1].child);
      family_keys(now.child, nearer.keys, farther.keys);
      math::put_in_order(nearer, farther);
      now = math::next_of(last, nearer, farther, left);
      if (now.what > last) break;
      ++steps;
      if (static_cast<uint32_t>(now.child) >= kBlockBit) break;
    }
    while (true) {  // until it is an inner node
      if (now.what > last) {
        if (now.what == UINT64_MAX) {
          search.steps = steps;
          return;
        }
        now = *left--;
        steps += now.what <= last ? 1 : 0;
        continue;
      }
      const uint32_t child = static_cast<uint32_t>(now.child), slot = low_half(now.what);
      if (child < kBlockBit) break;
      const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
      Best& best = search.best;
      const float before2_m2 = best.distance2_m2;
      if (!is_leaf(child)) {
        const uint32_t node = block_node(child);
        const NodeBlock& block = ahead.blocks[node];
        uint64_t a_keys, b_keys;
        if (is_large) fetch_corners(ahead, static_cast<uint32_t>(left->child), node);
        family_keys(node, a_keys, b_keys);
        const Feet<math::FloatWide> feet = feet_on<math::FloatWide>(Lined(ahead, block.of), p_m);
        uint32_t prune = high_half(last + 1);
        const BlockKeys keys(block.lanes, now.keys, a_keys, b_keys);
        if (nearer_of(feet, block.of, before2_m2) == 0) {
          steps += keys.steps(prune);
        } else {
          steps += take_in_turn(feet, block, keys, bound, families[slot].side, node, prune, best);
          last = (uint64_t{prune} << 32) - 1;
        }
      } else if (measure_lined<math::FloatWide>(Lined(ahead, child), p_m, slot, before2_m2, best) <
                 before2_m2) {
        last = (uint64_t{prune_key(bound, search)} << 32) - 1;
      }
      // Where its direction stands is asked for while the search goes on.
      if (best.distance2_m2 < before2_m2)
        __builtin_prefetch(ahead.directions + size_t{kFeatures} * best.triangle +
                           static_cast<uint32_t>(best.feature));
      now = *left--;
      steps += now.what <= last ? 1 : 0;
    }
  }
}

// A block of which something may be nearer; its steps below the node. Mostly nothing may: a function of its own takes no registers from the loop.
[[gnu::noinline, maybe_unused]] uint32_t measure_block(const Ahead& ahead, uint32_t node,
                                                       const NearBound& bound, uint32_t& prune,
                                                       Search& search) {
  const Side* const sides = ahead.block_nodes[node].side;
  const Node* const family = ahead.families + 2 * uint64_t{node};
  uint32_t key0, key1, child0, child1;
  bound.keys(sides, key0, key1, child0, child1);
  uint64_t a_keys, b_keys;
  math::family_distances2(family[0].side[0].box, family[1].side[0].box, bound.point, a_keys,
                          b_keys);
  const NodeBlock& block = ahead.blocks[node];
  const BlockKeys keys(block.lanes, math::keys_of(key0, key1), a_keys, b_keys);
  const Feet<math::FloatWide> feet =
      feet_on<math::FloatWide>(Lined(ahead, block.of), {search.p_m.x, search.p_m.y, search.p_m.z});
  if (nearer_of(feet, block.of, search.best.distance2_m2) == 0) return keys.steps(prune);
  return take_in_turn(feet, block, keys, bound, sides, node, prune, search.best);
}

/// search_nearest() of a query that knows its last leaf and that no budget cuts short: what it reads, in
/// its order, the same steps. Mostly a bound tells at once that nothing in a block is nearer.
/// Pre: search.start != kNowhere; search.budget is not reached.
[[gnu::noinline, gnu::flatten, maybe_unused]] void climb_ahead(const View& mesh,
                                                               const NearBound& bound_at,
                                                               Search& search) {
  const NearBound bound = bound_at;  // in registers
  const Ahead& ahead = *mesh.ahead();
  const Side* const sides = ahead.block_nodes->side;
  const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
  const float slack_m2 = search.slack_m2;
  Best& best = search.best;
  const uint32_t clear = measure_lined_last<math::FloatWide>(
      Lined(ahead, sides[search.start].child), p_m, search.start, search.last, slack_m2, best);
  uint32_t prune = prune_key(bound, search), left = UINT32_MAX - 1, slot;
  float limit2_m2 = prism_limit2(best.distance2_m2, slack_m2);
  Pending pending[kCapacity];
  Pending* top = pending;
  climb(mesh, sides, bound, prune, left, top, search);
  while (take_last(top, pending, prune, slot)) {
    uint32_t child = sides[slot].child;
    for (--left; child < kBlockBit; --left)
      if (!enter(sides, bound, prune, child, slot, top)) break;
    if (child < kBlockBit) continue;
    if (!is_leaf(child)) {
      const uint32_t node = block_node(child);
      const NodeBlock& block = ahead.blocks[node];
      const Lined lined(ahead, block.of);
      if (may_be_nearer<math::FloatWide>(lined, p_m, limit2_m2) == 0) {
        const uint32_t* const below = ahead.families[2 * uint64_t{node}].side[0].box;
        left -= static_cast<uint32_t>(__builtin_popcount(
            math::boxes_below(sides[2 * node].box, below, bound.point, prune) & block.boxes));
        continue;
      }
      left -= measure_block(ahead, node, bound_at, prune, search);
    } else {
      const float before2_m2 = best.distance2_m2;
      if (lined_block(child).first == clear ||
          !(measure_lined_beside<math::FloatWide>(Lined(ahead, child), p_m, slot, before2_m2,
                                                  limit2_m2, best) < before2_m2))
        continue;
      prune = prune_key(bound, search);
    }
    limit2_m2 = prism_limit2(best.distance2_m2, slack_m2);
  }
  search.complete = true;
  search.steps = UINT32_MAX - left;
}

}  // namespace
}  // namespace firmtouch::mesh
