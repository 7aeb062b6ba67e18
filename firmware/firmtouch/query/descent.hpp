#pragma once
#include <stdint.h>

#include "firmtouch/query/work.hpp"

// The depth-first traversal of a binary tree. For the library's own translation units.

namespace firmtouch::query {

/// End of a descent: whether all was visited that may matter; else the least key of what was not.
template <class Key>
struct Descent {
  bool is_done;
  Key pending;
};

/// Visits the leaves of a binary tree, nearest child first. `Search` has
///     struct Node { Key key; ... };            key: certified, nothing inside has a smaller one
///     Node root();
///     bool is_leaf(const Node& node);
///     void open(const Node& node, Node& one, Node& other);          the children, with their keys
///     bool leaf(const Node& node);                                  whether more are wanted
///     Key limit();                                                  largest key of interest
///     kLeafWork                                         units of a leaf beyond its visit, at most
/// kDepth: of the tree; one pending node a level suffices.
/// Bounds: <= work.left units; kDepth + 4 nodes of stack.
template <uint32_t kDepth, class Search>
[[gnu::always_inline]] inline auto descend(Search& search, Work& work)
    -> Descent<decltype(search.root().key)> {
  using Node = decltype(search.root());
  Node pending[kDepth + 1];
  uint32_t count = 0;
  Node now = search.root();
  while (true) {
    if (now.key <= search.limit()) {
      if (!work.visit()) break;
      if (!search.is_leaf(now)) {
        Node one, other;
        search.open(now, one, other);
        const bool swap = other.key < one.key;
        const Node& farther = swap ? one : other;
        if (farther.key <= search.limit()) pending[count++] = farther;
        now = swap ? other : one;
        continue;
      }
      work.charge(Search::kLeafWork);
      if (!search.leaf(now)) return {true, now.key};
    }
    if (count == 0) return {true, now.key};
    now = pending[--count];
  }
  for (uint32_t i = 0; i < count; ++i)
    if (pending[i].key < now.key) now.key = pending[i].key;
  return {false, now.key};
}

}  // namespace firmtouch::query
