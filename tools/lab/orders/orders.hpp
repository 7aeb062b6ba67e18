#pragma once
#include "lab/orders/search.hpp"

namespace firmtouch::lab::orders {

enum class Order { kDepthFirst, kBestFirst, kBreadthFirst };

// Boxes that the priority queue holds; where it is full, the rest goes on a stack that is emptied
// first, so that nothing is lost. The most that 2,000 random points on real models wanted is
// printed in the bench's table.
constexpr uint32_t kQueueBoxes = 256;
constexpr uint32_t kStackBoxes = 3 * mesh::kMaxDepth + 4;
// Breadth-first keeps a whole level.
constexpr uint32_t kRingBoxes = 1u << 17;

/// Nearest child first, last in first out.
template <class S>
bool depth_first(S& search, Pending* pending) {
  uint32_t count = 0;
  Pending found[S::kWays];
  uint32_t child = 0;
  while (true) {
    if (mesh::is_leaf(child)) {
      search.read_leaf(child);
    } else if (const uint32_t n = search.read_node(child, found); n > 0) {
      for (uint32_t i = n; i-- > 1;) pending[count++] = found[i];
      search.note_pending(count);
      child = found[0].child;
      continue;
    }
    do {
      if (count == 0) return true;
    } while (pending[--count].key >= search.prune());
    child = pending[count].child;
  }
}

/// Reads a leaf or a node. Result: how many children of a node are found.
template <class S>
uint32_t read(S& search, uint32_t child, Pending* found) {
  if (!mesh::is_leaf(child)) return search.read_node(child, found);
  search.read_leaf(child);
  return 0;
}

static inline void sift_up(Pending* heap, uint32_t at) {
  const Pending up = heap[at];
  for (uint32_t parent; at > 0 && up.key < heap[parent = (at - 1) / 2].key; at = parent)
    heap[at] = heap[parent];
  heap[at] = up;
}

static inline void sift_down(Pending* heap, uint32_t count, Pending down) {
  uint32_t at = 0;
  for (uint32_t next; (next = 2 * at + 1) < count; at = next) {
    if (next + 1 < count && heap[next + 1].key < heap[next].key) ++next;
    if (!(heap[next].key < down.key)) break;
    heap[at] = heap[next];
  }
  heap[at] = down;
}

/// The box with the least lower bound of all, by a binary heap of kQueueBoxes. The end is where the
/// least bound is no less than the best distance.
/// Source: Baerentzen & Aanaes 2005, sections 4.1 and 4.2.
template <class S>
bool best_first(S& search, Pending* pending) {
  Pending* const heap = pending;
  Pending* const stack = pending + kQueueBoxes;
  uint32_t heaped = 0, stacked = 0;
  Pending found[S::kWays];
  Pending now{0, 0};
  while (true) {
    for (uint32_t i = read(search, now.child, found); i-- > 0;) {
      if (heaped < kQueueBoxes) {
        heap[heaped] = found[i];
        sift_up(heap, heaped++);
      } else {
        stack[stacked++] = found[i];
        search.note_overflow();
      }
    }
    search.note_pending(heaped + stacked);
    if (stacked > 0) {
      now = stack[--stacked];
      if (now.key >= search.prune()) now.child = kNoChild;  // reads as an empty leaf
      continue;
    }
    if (heaped == 0 || heap[0].key >= search.prune()) return true;
    now = heap[0];
    const Pending last = heap[--heaped];
    if (heaped > 0) sift_down(heap, heaped, last);
  }
}

/// A level after the other, by a ring of kRingBoxes. Result: false where that is not enough.
/// Source: Morris 2006, section 3.3, as what depth-first is compared with.
template <class S>
bool breadth_first(S& search, Pending* pending, uint32_t ring_boxes) {
  uint32_t head = 0, tail = 0;
  Pending found[S::kWays];
  Pending now{0, 0};
  while (true) {
    const uint32_t n = read(search, now.child, found);
    if (ring_boxes - (tail - head) < n) return false;
    for (uint32_t i = 0; i < n; ++i) pending[tail++ & (ring_boxes - 1)] = found[i];
    search.note_pending(tail - head);
    do {
      if (head == tail) return true;
      now = pending[head++ & (ring_boxes - 1)];
    } while (now.key >= search.prune());
  }
}

/// Where boxes wait: at least kQueueBoxes + kStackBoxes, for breadth-first a power of two.
struct Waiting {
  Pending* boxes;
  uint32_t count;
};

template <Order kOrder, class S>
bool search_in_order(S& search, Waiting waiting) {
  if constexpr (kOrder == Order::kDepthFirst) return depth_first(search, waiting.boxes);
  if constexpr (kOrder == Order::kBestFirst) return best_first(search, waiting.boxes);
  return breadth_first(search, waiting.boxes, waiting.count);
}

/// The nearest of the tree's mesh to `p_m`. Result: false where too many boxes wait.
template <class K, Order kOrder, Upper kUpper, bool kCount>
bool find_nearest(const Tree<K>& tree, Vec3 p_m, Waiting waiting, Counters& counters,
                  Nearest& nearest) {
  Search<K, typename K::Query, kUpper, kCount> near(tree, p_m, counters);
  if (near.begin()) {
    const bool done = search_in_order<kOrder>(near, waiting);
    nearest = near.nearest();
    return done;
  }
  Search<K, typename K::FarQuery, kUpper, kCount> far(tree, p_m, counters);
  const bool done = far.begin() && search_in_order<kOrder>(far, waiting);
  nearest = far.nearest();
  return done;
}

template <class K>
struct Variant {
  Order order;
  Upper upper;
  bool (*run)(const Tree<K>&, Vec3, Waiting, Counters&, Nearest&);
  bool (*count)(const Tree<K>&, Vec3, Waiting, Counters&, Nearest&);
};

template <class K, Order kOrder, Upper kUpper>
constexpr Variant<K> variant() {
  return {kOrder, kUpper, find_nearest<K, kOrder, kUpper, false>,
          find_nearest<K, kOrder, kUpper, true>};
}

template <class K, int... kPair>
struct Variants {
  static constexpr Variant<K> kAll[] = {variant<K, Order{kPair / 4}, Upper{kPair % 4}>()...};
};

/// Every order with every upper bound, over one kind of boxes.
template <class K>
inline constexpr auto& kVariants = Variants<K, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11>::kAll;

}  // namespace firmtouch::lab::orders
