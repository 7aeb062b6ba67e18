#pragma once
// Boxes that a search for the nearest triangle has still to visit. For closest_point.cpp alone.

#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::mesh {
namespace {

// Pending boxes: smallest key first while a whole descent fits, else last in first out, which needs
// at most kMaxDepth entries. With 16 entries for smallest first instead of 64 the lower bounds of
// 64 visits change by less than 0.1 % (`firmtouch bench`), and the stack takes 384 B less.
constexpr uint32_t kBestFirst = 16;
constexpr uint32_t kCapacity = kBestFirst + kMaxDepth;

// A slot is a box: node << 1 | which of its two.
struct Pending {
  uint32_t key;
  uint32_t slot;
};

// Result of take_smallest().
struct Taken {
  uint32_t slot;
  uint32_t count;  // still pending
  uint32_t left;   // of the budget
  bool found;
};

// Pops the leaf of the smallest key below `prune`; inner nodes of the smallest key are replaced by
// their boxes. So the lower bound of a search that is cut short rises fastest. With kBestFirst or
// more pending, or nothing `left`, it returns the box that is next, inner node or not. noinline:
// inlined it takes registers of the warm search, which does not use it.
template <class Bound>
[[gnu::noinline]] Taken take_smallest(const Side* sides, const Bound& bound, Pending* pending,
                                      uint32_t count, uint32_t prune, uint32_t left,
                                      uint32_t& charged) {
  while (count != 0) {
    const uint32_t scan = 1 + (count >> 3), taken_parts = scan < left ? scan : left;
    left -= taken_parts;
    charged += taken_parts;
    uint32_t at = count - 1;
    for (uint32_t i = at; i-- > 0;) at = pending[i].key < pending[at].key ? i : at;
    const Pending taken = pending[at];
    pending[at] = pending[--count];
    if (taken.key >= prune) break;
    const uint32_t child = sides[taken.slot].child;
    if (is_leaf(child) || left == 0 || count >= kBestFirst) return {taken.slot, count, left, true};
    --left;
    uint32_t key0, key1, child0, child1;
    bound.keys(sides + 2 * child, key0, key1, child0, child1);
    if (key0 < prune) pending[count++] = {key0, 2 * child};
    if (key1 < prune) pending[count++] = {key1, 2 * child + 1};
  }
  return {0, 0, left, false};
}

[[gnu::always_inline]] inline void push(Pending*& top, uint32_t key, uint32_t slot) {
  uint32_t* word = &top->key;
  math::push_pair(word, key, slot);
  top = reinterpret_cast<Pending*>(word);
}

// Pops the last slot with a key below `prune`. Result: false if none is left above `best_first`.
inline bool take_last(Pending*& top, const Pending* best_first, uint32_t prune, uint32_t& slot) {
  while (top > best_first) {
    --top;
    slot = top->slot;
    if (top->key < prune) return true;
  }
  return false;
}

}  // namespace
}  // namespace firmtouch::mesh
