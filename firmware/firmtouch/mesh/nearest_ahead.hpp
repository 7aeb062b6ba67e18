#pragma once
// The search for the nearest triangle on a processor that runs ahead and has vector instructions. For
// closest_point.cpp alone.

#include "firmtouch/math/isa_ahead.hpp"
#include "firmtouch/mesh/block.hpp"
#include "firmtouch/mesh/nearest_search.hpp"

namespace firmtouch::mesh {
namespace {

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
      family_keys(now.child, nearer.keys, farther.keys);
      math::put_in_order(nearer, farther);
      const WaitingChild left_last = *left;
      left[1] = farther;
      left += farther.what <= last ? 1 : 0;
      left -= nearer.what <= last ? 0 : 1;
      math::replace_beyond(last, nearer, left_last);
      now = nearer;
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
      const uint32_t child = static_cast<uint32_t>(now.child), place = low_half(now.what);
      if (child < kBlockBit) break;
      const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
      Best& best = search.best;
      const float before2_m2 = best.distance2_m2;
      if (!is_leaf(child)) {
        const uint32_t node = block_node(child);
        const NodeBlock& block = ahead.blocks[node];
        uint64_t a_keys, b_keys;
        family_keys(node, a_keys, b_keys);
        const Feet<math::FloatWide> feet = feet_on<math::FloatWide>(Lined(ahead, block.of), p_m);
        uint32_t prune = high_half(last + 1);
        const BlockKeys keys(block.lanes, now.keys, a_keys, b_keys);
        const uint32_t nearer = math::lanes_of(
            math::less(feet.distance2_m2, lanes::all_of<math::FloatWide>(before2_m2)));
        if ((nearer & ((1u << block.of.count) - 1u)) == 0) {
          steps += keys.steps(prune);
        } else {
          steps += take_in_turn(feet, block, keys, bound, families[place].side, node, prune, best);
          last = (uint64_t{prune} << 32) - 1;
        }
      } else if (measure_lined<math::FloatWide>(Lined(ahead, child), p_m, place, before2_m2, best) <
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

}  // namespace
}  // namespace firmtouch::mesh
