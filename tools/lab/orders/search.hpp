#pragma once
// Three orders in which a tree may be searched for the nearest triangle, over any kind of boxes and
// with four upper bounds. What they share is here, the orders are in orders.hpp.
#include <float.h>

#include "firmtouch/mesh/triangle.hpp"
#include "lab/orders/tree.hpp"

namespace firmtouch::lab::orders {

enum class Upper { kNone, kVertex, kFarCorner, kMinMax };

struct Counters {
  uint32_t nodes = 0;  // read, leaves among them: steps
  uint32_t boxes = 0, triangles = 0;
  uint32_t max_pending = 0;
  uint32_t overflows = 0;  // how often a queue was full
};

/// What a search found.
struct Nearest {
  float distance2_m2 = FLT_MAX;
  Vec3 offset_m;  // from the closest point to the query
  uint32_t triangle = 0;
  mesh::Feature feature = mesh::Feature::kVertex0;
};

/// A box still to be looked at.
struct Pending {
  uint32_t key, child;
};

template <class K, class Query, Upper kUpper, bool kCount>
class Search {
 public:
  using Node = typename K::Node;
  static constexpr uint32_t kWays = K::kWays;

  Search(const Tree<K>& tree, Vec3 p_m, Counters& counters)
      : tree_(tree), p_m_(p_m), counters_(counters) {}

  bool begin() { return query_.begin(tree_.mesh->head(), p_m_); }
  /// Nothing at this key or beyond can be the nearest.
  uint32_t prune() const { return prune_; }
  const Nearest& nearest() const { return nearest_; }

  void read_leaf(uint32_t child) {
    uint32_t i = mesh::leaf_first(child);
    const uint32_t end = i + mesh::leaf_count(child);
    if constexpr (kCount) ++counters_.nodes, counters_.triangles += end - i;
    const float before2_m2 = nearest_.distance2_m2;
    for (; i < end; ++i) {
      const mesh::Triangle<uint32_t> t = tree_.mesh->triangle(i);
      const mesh::Foot foot = mesh::closest_on_triangle(p_m_, tree_.mesh->vertex(t.corner[0]),
                                                        tree_.mesh->vertex(t.corner[1]),
                                                        tree_.mesh->vertex(t.corner[2]));
      if (foot.distance2_m2 < nearest_.distance2_m2)
        nearest_ = {foot.distance2_m2, foot.offset_m, i, foot.feature};
    }
    if (nearest_.distance2_m2 < before2_m2) lower_prune(nearest_.distance2_m2);
  }

  /// The children of a node with their keys, nearest first; those that cannot hold the nearest are
  /// left out. Result: how many.
  uint32_t read_node(uint32_t index, Pending* found) {
    const Node& node = tree_.nodes[index];
    uint32_t count = 0;
    if constexpr (kCount) ++counters_.nodes;
    for (uint32_t slot = 0; slot < kWays; ++slot) {
      if (kWays > 2 && node.child[slot] == kNoChild) break;
      if constexpr (kCount) ++counters_.boxes;
      const uint32_t key = query_.key(node.box[slot]);
      if (key >= prune_) continue;
      lower_by(node.box[slot], index * kWays + slot);
      uint32_t at = count++;
      for (; at > 0 && key < found[at - 1].key; --at) found[at] = found[at - 1];
      found[at] = {key, node.child[slot]};
    }
    while (count > 0 && found[count - 1].key >= prune_) --count;
    return count;
  }

  void note_pending(uint32_t count) {
    if constexpr (kCount)
      if (count > counters_.max_pending) counters_.max_pending = count;
  }
  void note_overflow() {
    if constexpr (kCount) ++counters_.overflows;
  }

 private:
  void lower_prune(float upper2_m2) {
    const uint32_t key = query_.prune_key(upper2_m2);
    if (key < prune_) prune_ = key;
  }
  // The surface comes as near as this box says, at least. Widened by more than float32 loses.
  void lower_by(const typename K::Box& box, uint32_t place) {
    if constexpr (kUpper == Upper::kVertex) {
      const Vec3 from = p_m_ - tree_.mesh->vertex(tree_.middle[place]);
      lower_prune(dot(from, from) * kWiden);
    } else if constexpr (kUpper == Upper::kFarCorner) {
      lower_prune(farthest2_m2(query_.sides(box)) * kWiden);
    } else if constexpr (kUpper == Upper::kMinMax) {
      lower_prune(minmax2_m2(query_.sides(box), query_.touch_slack_m(box)) * kWiden);
    }
  }

  static constexpr float kWiden = 1.0f + 0x1p-16f;
  const Tree<K>& tree_;
  Vec3 p_m_;
  Counters& counters_;
  Query query_;
  uint32_t prune_ = UINT32_MAX;
  Nearest nearest_;
};

}  // namespace firmtouch::lab::orders
