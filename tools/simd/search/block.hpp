#pragma once
// A block's triangles are measured at once. Best, cutoff and visits are then those of the scalar
// search, which reads one leaf after the other.

#include "firmtouch/mesh/grid.hpp"
#include "simd/search/leaf.hpp"

namespace firmtouch::simd {

using mesh::kFarthest;
using mesh::NearBound;

constexpr uint32_t low_half(uint64_t both) { return static_cast<uint32_t>(both); }
constexpr uint32_t high_half(uint64_t both) { return static_cast<uint32_t>(both >> 32); }
// Without a branch: no predictor can learn it, and compilers make one of a condition.
constexpr uint32_t chosen(bool is, uint32_t one, uint32_t other) {
  const uint32_t mask = 0u - static_cast<uint32_t>(is);
  return (one & mask) | (other & ~mask);
}

/// bound.prune_key(), without a branch: most blocks have fewer than four leaves, and no predictor
/// learns which.
[[gnu::always_inline]] static inline uint32_t prune_key_of(const NearBound& bound,
                                                           float distance2_m2) {
  const uint32_t bits = math::bits_of(distance2_m2 * bound.prune_per_m2);
  const bool is_near = bits < math::bits_of(4.2e9f);  // floats of 0 and above order as their bits
  const float cells2 = math::float_of(chosen(is_near, bits, 0));
  return chosen(is_near, static_cast<uint32_t>(cells2) + 1, kFarthest);
}

/// The keys of the boxes below a block's node. A child that is a leaf counts as its own leaf 0.
/// Boxes that are not there have a key that no cutoff exceeds.
struct BlockKeys {
  uint32_t child[2], leaf[4];
  uint32_t is_later_first, are_leaves_swapped[2];  // the nearer of two first; equal: side 0

  /// `keys`: of both children; `a_keys`, `b_keys`: of those in each.
  BlockKeys(uint32_t lanes, uint64_t keys, uint64_t a_keys, uint64_t b_keys) {
    const bool has_a = (lanes & 0xFF00u) != 0, has_b = (lanes & 0xFF000000u) != 0;
    child[0] = chosen(has_a, low_half(keys), kFarthest);
    child[1] = chosen(has_b, high_half(keys), kFarthest);
    leaf[0] = chosen(has_a, low_half(a_keys), low_half(keys));
    leaf[1] = chosen(has_a, high_half(a_keys), kFarthest);
    leaf[2] = chosen(has_b, low_half(b_keys), high_half(keys));
    leaf[3] = chosen(has_b, high_half(b_keys), kFarthest);
    is_later_first = high_half(keys) < low_half(keys) ? 1 : 0;
    are_leaves_swapped[0] = leaf[1] < leaf[0] ? 1 : 0;
    are_leaves_swapped[1] = leaf[3] < leaf[2] ? 1 : 0;
  }
  /// Visits if nothing is nearer: the boxes below `prune`, for a box lies in its parent's.
  uint32_t steps(uint32_t prune) const {
    const auto is = [prune](uint32_t key) { return key < prune ? 1u : 0u; };
    return is(child[0]) + is(child[1]) + is(leaf[0]) + is(leaf[1]) + is(leaf[2]) + is(leaf[3]);
  }
};

/// Sets `best` and `prune` as the scalar search does. `feet`: of the block's triangles; `sides`: of
/// its node. Result: the visits below the node.
[[gnu::always_inline]] static inline uint32_t take_block(const Feet& feet, const NodeBlock& block,
                                                         const BlockKeys& keys,
                                                         const NearBound& bound, const Side* sides,
                                                         uint32_t node, uint32_t& prune,
                                                         Best& best) {
  uint32_t least[4], key_after[4];
#pragma GCC unroll 4
  for (uint32_t i = 0; i < 4; ++i) {
    const float min2_m2 = minimum_of(feet.distance2_m2, (block.lanes >> (8 * i)) & 0xFFu);
    least[i] = math::bits_of(min2_m2);  // these order as the squares do: none is below 0
    key_after[i] = prune_key_of(bound, min2_m2);
  }
  uint32_t steps = 0, found = math::bits_of(best.distance2_m2), nearest = 4;
#pragma GCC unroll 2
  for (uint32_t i = 0; i < 2; ++i) {
    const uint32_t child = i ^ keys.is_later_first;
    steps += keys.child[child] < prune ? 1 : 0;
#pragma GCC unroll 2
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t leaf = 2 * child + (k ^ keys.are_leaves_swapped[child]);
      const bool is_read = keys.leaf[leaf] < prune;
      const bool is_nearer = is_read & (least[leaf] < found);
      steps += is_read ? 1 : 0;
      prune = chosen(is_read & (key_after[leaf] < prune), key_after[leaf], prune);
      found = chosen(is_nearer, least[leaf], found);
      nearest = chosen(is_nearer, leaf, nearest);
    }
  }
  if (nearest == 4) return steps;
  const uint32_t which = nearest >> 1, child = sides[which].child;
  const uint32_t slot = chosen(is_leaf(child), 2 * node + which, 2 * child + (nearest & 1));
  put_nearest(feet, (block.lanes >> (8 * nearest)) & 0xFFu, block.of.first, slot, best);
  return steps;
}

/// The same of a mesh with rivals.
static inline uint32_t take_block(const Feet& feet, const CornerArrays& corners,
                                  const NodeBlock& block, const BlockKeys& keys,
                                  const NearBound& bound, const Side* sides, uint32_t node,
                                  uint32_t& prune, Best& best, mesh::Rivals& rivals) {
  uint32_t steps = 0;
  for (uint32_t i = 0; i < 2; ++i) {
    const uint32_t which = i ^ keys.is_later_first, child = sides[which].child;
    steps += keys.child[which] < prune ? 1 : 0;
    for (uint32_t k = 0; k < 2; ++k) {
      const uint32_t leaf = 2 * which + (k ^ keys.are_leaves_swapped[which]);
      if (!(keys.leaf[leaf] < prune)) continue;
      ++steps;
      const uint32_t slot = is_leaf(child) ? 2 * node + which : 2 * child + (leaf & 1);
      if (take_rivals(feet, corners, (block.lanes >> (8 * leaf)) & 0xFFu, block.of.first, slot,
                      best, rivals)) {
        const uint32_t key_after = bound.prune_key(best.distance2_m2);
        prune = key_after < prune ? key_after : prune;
      }
    }
  }
  return steps;
}

}  // namespace firmtouch::simd
