#pragma once
// The search for the nearest triangle: the room's inner loop. For closest_point.cpp alone.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "firmtouch/mesh/leaf.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/hint.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

// Boxes still to be looked at. Smallest key first while there is room for a whole descent, last in
// first out beyond, which needs kMaxDepth entries at most. 64 entries for smallest first: within
// the 64 steps of a tick's budget it never overflows.
constexpr uint32_t kBestFirst = 64;
constexpr uint32_t kCapacity = kBestFirst + kMaxDepth;

// A place is a box: node << 1 | which of its two.
struct Pending {
  uint32_t key;
  uint32_t place;
};

/// In: the best so far and the last fence, the subtree outside which everything is at least fence_m
/// away. Out: the same, renewed, and what the search came to.
struct Search {
  Best best;
  uint32_t fence;
  float fence_m;
  float band2_m2;        // in: what is farther off need not be found
  float fence_margin_m;  // in: how much farther than the first leaf a new fence should stand
  uint32_t steps;
  bool complete;    // nothing nearer can be left
  float pending_m;  // where it is not: certified distance to everything that was not looked at
};

template <class Number>
inline Number smaller(Number a, Number b) {
  return a < b ? a : b;
}

// What take_smallest() leaves.
struct Taken {
  uint32_t place;
  uint32_t count;  // still pending
  uint32_t left;   // of the budget
  bool found;
};

// Takes the leaf of the smallest key, which is below `prune`: where the smallest is an inner node's,
// both of its boxes take its place first. So the lower bound of a search that is cut short rises
// fastest. Where more than `best_first` are pending or nothing is `left`, what was about to be read.
// A function of its own: in the loop it would take the registers of the warm search, which does
// not use it.
template <class Bound>
[[gnu::noinline]] Taken take_smallest(const Side* sides, const Bound& bound, Pending* pending,
                                      uint32_t count, uint32_t best_first, uint32_t prune,
                                      uint32_t left) {
  while (count != 0) {
    uint32_t at = count - 1;
    for (uint32_t i = at; i-- > 0;) at = pending[i].key < pending[at].key ? i : at;
    const Pending taken = pending[at];
    pending[at] = pending[--count];
    if (taken.key >= prune) break;
    const uint32_t child = sides[taken.place].child;
    if (is_leaf(child) || left == 0 || count >= best_first) return {taken.place, count, left, true};
    --left;
    uint32_t key0, key1;
    bound.keys(sides + 2 * child, key0, key1);
    if (key0 < prune) pending[count++] = {key0, 2 * child};
    if (key1 < prune) pending[count++] = {key1, 2 * child + 1};
  }
  return {0, 0, left, false};
}

// Takes the last place of a key below `prune`.
// Result: false when none is left of more than `best_first`.
inline bool take_last(const Pending* pending, uint32_t& count, uint32_t best_first, uint32_t prune,
                      uint32_t& place) {
  while (count > best_first) {
    const Pending taken = pending[--count];
    place = taken.place;
    if (taken.key < prune) return true;
  }
  return false;
}

// From the leaf at `place`, which has been read, up to the fence where that is far enough away,
// else to the root, building the next fence: the highest node with a box beside the way that is
// nearer than the fence should be. Result: false where the budget ends on the way.
template <class Bound>
inline bool climb(const View& mesh, const Bound& bound, uint32_t place, uint32_t prune,
                  uint32_t& left, Pending* pending, uint32_t& count, Search& search) {
  const Side* const sides = mesh.sides();
  const uint32_t* const parents = mesh.parents().data();
  const float leaf_m =
      math::square_root(smaller(search.best.distance2_m2, search.band2_m2)) * (1.0f + 0x1p-22f);
  const float reach_m = leaf_m + search.fence_margin_m;
  const uint32_t beyond = bound.prune_key(reach_m * reach_m);
  uint32_t stop = leaf_m <= search.fence_m ? search.fence : 0, fence = place >> 1;
  while (left != 0) {
    --left;
    const uint32_t beside = place ^ 1u, index = place >> 1;
    const uint32_t key = bound.key(sides[beside].box);
    if (key < beyond) {
      fence = index;
      if (key < prune) pending[count++] = {key, beside};
    }
    if (index <=
        stop) {  // parents come before their children: at the fence, or past one that is no ancestor
      if (index == 0) {
        search.fence = fence;
        search.fence_m = reach_m * (1.0f - 0x1p-22f);
        return true;
      }
      if (index == stop) return true;
      stop = 0;
    }
    place = place_of(parents[index]);
  }
  return false;
}

// One loop with its state in registers. A box is a place; a leaf that is reached is read, an inner
// node is entered by its nearer child, the other left in `pending`. A warm search begins with the
// last leaf and climbs from there to the root, leaving in `pending` what lies beside the way.
// A function of its own: beside its caller's values the loop's do not stay in registers.
template <bool kCareful, class Bound, class Index>
[[gnu::noinline]] void search_nearest(const View& mesh, core::Span<const Triangle<Index>> triangles,
                                      const Bound& bound_at, Vec3 p_m, uint32_t budget,
                                      uint32_t start, Search& search) {
  const Bound bound = bound_at;  // in registers
  const float px_m = p_m.x, py_m = p_m.y, pz_m = p_m.z;
  const Loss loss(mesh.head());
  const Vertex* const vertices = mesh.vertices().data();
  const Side* const sides = mesh.sides();
  const uint32_t allowed = budget == 0 ? 1 : budget;
  Pending pending[kCapacity];
  uint32_t count = 0, left = allowed;
  float least2_m2 = search.best.distance2_m2;
  const uint32_t band = bound.prune_key(search.band2_m2);
  uint32_t prune = smaller(bound.prune_key(least2_m2), band);
  bool climbing = start != query::kNowhere;
  // Where nothing cuts a search short no lower bound is told on the way.
  const uint32_t best_first = climbing || budget == UINT32_MAX ? 0 : kBestFirst;
  uint32_t place = start;
  uint32_t child = climbing ? sides[start].child : 0;  // else the root
  while (left != 0) {
    --left;
    if (!is_leaf(child)) {
      uint32_t key0, key1;
      bound.keys(sides + 2 * child, key0, key1);
      place = 2 * child;
      if (key0 < prune) {
        if (key1 < prune) {
          if (key1 < key0) {
            pending[count++] = {key0, place};
            place |= 1u;
          } else {
            pending[count++] = {key1, place | 1u};
          }
        }
        child = sides[place].child;
        continue;
      }
      if (key1 < prune) {
        place |= 1u;
        child = sides[place].child;
        continue;
      }
    } else {
      const float before2_m2 = least2_m2;
      least2_m2 = measure_leaf<kCareful>(vertices, triangles, loss, Vec3{px_m, py_m, pz_m}, child,
                                         place, climbing, least2_m2, search.best);
      if (least2_m2 < before2_m2) prune = smaller(bound.prune_key(least2_m2), band);
      if (climbing) {
        if (!climb(mesh, bound, start, prune, left, pending, count, search)) break;
        climbing = false;
      }
    }
    // Many, or warm: the last, whose order does not matter then and costs nothing.
    if (!take_last(pending, count, best_first, prune, place)) {
      bool found = count != 0;
      if (found) {
        const Taken taken = take_smallest(sides, bound_at, pending, count, best_first, prune, left);
        found = taken.found;
        place = taken.place;
        count = taken.count;
        left = taken.left;
      }
      if (!found) {
        search.complete = true;
        search.steps = allowed - left;
        return;
      }
    }
    child = sides[place].child;
  }
  // The budget ran out: what was about to be read is left too.
  search.complete = false;
  search.steps = allowed - left;
  const bool nothing = climbing || place == query::kNowhere;
  uint32_t least = nothing ? 0 : bound.key(sides[place].box);
  for (uint32_t i = 0; i < count; ++i) least = pending[i].key < least ? pending[i].key : least;
  search.pending_m = bound.distance_m(least);
}

}  // namespace
}  // namespace firmtouch::mesh
