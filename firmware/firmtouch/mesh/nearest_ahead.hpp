#pragma once
// The search for the nearest triangle on a processor that runs ahead. For closest_point.cpp alone.

#include "firmtouch/math/isa_ahead.hpp"
#include "firmtouch/mesh/nearest_search.hpp"

namespace firmtouch::mesh {
namespace {

// Asks for the rows of a leaf; of an inner node for none in particular.
inline void prefetch_rows(const float* rows, uint64_t child) {
  const uint32_t word = static_cast<uint32_t>(child);
  const uint32_t is_leaf_mask = static_cast<uint32_t>(static_cast<int32_t>(word) >> 31);
  const float* const row = rows + size_t{kRowsOfLeaf} * (leaf_first(word) & is_leaf_mask);
  for (size_t line = 0; line < 4; ++line) __builtin_prefetch(row + 16 * line);
}

/// search_nearest() of a query that knows no leaf to begin with and that no budget cuts short: the
/// same leaves in the same order, the same steps. While the processor waits to know which of two
/// children is nearer it measures the boxes in both; who is next is moved under a condition, not
/// jumped to. A node's keys are those of its sides, measured when it was found; what `last` is may
/// have come nearer since.
/// Pre: search.start == kNowhere; search.budget is not reached.
template <class Index>
[[gnu::noinline, gnu::flatten]] void search_ahead(const View& mesh, const NearBound& bound_at,
                                                  Search& search) {
  using math::WaitingChild;
  const NearBound bound = bound_at;
  const Side* const sides = mesh.sides();
  const auto boxes = [sides](uint64_t child) {  // of a leaf those of the root
    const uint32_t word = static_cast<uint32_t>(child);
    const uint32_t inner = word & ~static_cast<uint32_t>(static_cast<int32_t>(word) >> 31);
    return sides[2 * size_t{inner}].box;
  };
  // The last of all that is below the key to prune by: the key above the place.
  const auto last_of = [&] { return (uint64_t{prune_key(bound, search)} << 32) - 1; };
  WaitingChild pending[kMaxDepth + 2];
  WaitingChild* left = pending;
  *left = {UINT64_MAX, 0, 0};
  WaitingChild now{0, 0, 0};
  uint64_t again, last = last_of();
  math::family_distances2(boxes(0), boxes(0), bound.point, now.keys, again);
  search.complete = true;
  begin_leaves<Index>(mesh, bound, search);
  uint32_t steps = 1;
  while (true) {
    while (true) {  // from inner node to inner node, without a branch
      const Side* const side = sides + 2 * now.child;
      WaitingChild nearer{(now.keys << 32) | (2 * now.child), 0, side[0].child};
      WaitingChild farther{(now.keys >> 32 << 32) | (2 * now.child + 1), 0, side[1].child};
      math::family_distances2(boxes(nearer.child), boxes(farther.child), bound.point, nearer.keys,
                              farther.keys);
      math::put_in_order(nearer, farther);
      if constexpr (kIsRows<Index>) {
        prefetch_rows(mesh.rows(), side[0].child);
        prefetch_rows(mesh.rows(), side[1].child);
      }
      const WaitingChild left_last = *left;
      left[1] = farther;
      left += farther.what <= last ? 1 : 0;
      left -= nearer.what <= last ? 0 : 1;
      math::replace_beyond(last, nearer, left_last);
      now = nearer;
      if (now.what > last) break;
      ++steps;
      if (is_leaf(static_cast<uint32_t>(now.child))) break;
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
      const uint32_t child = static_cast<uint32_t>(now.child);
      if (!is_leaf(child)) break;
      const uint32_t prune = static_cast<uint32_t>((last + 1) >> 32);
      if (measure<false, Index, Which::kAny>(mesh, prune, child, static_cast<uint32_t>(now.what),
                                             search))
        last = last_of();
      now = *left--;
      steps += now.what <= last ? 1 : 0;
    }
  }
}

}  // namespace
}  // namespace firmtouch::mesh
