#pragma once
#include <cstdint>
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

struct Box {
  Point low, high;
};

/// Makes `box` contain `by`.
void grow(Box& box, const Box& by);

/// Boxes of many items, found by overlap. For the offline checks: a complete binary tree over the
/// items in Morton order.
/// Bounds: building O(n log n), no recursion.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> items);

  /// Appends to `found` the items whose box overlaps `box` (touching counts), in a fixed order.
  void overlaps(const Box& box, std::vector<uint32_t>& found) const;
  /// Of all items.
  const Box& bounds() const { return nodes_[0]; }

 private:
  static constexpr uint32_t kLeafItems = 4;

  std::vector<Box> items_;       // as the leaves hold them
  std::vector<uint32_t> order_;  // their numbers
  // Children of i: 2 i + 1 and 2 i + 2; the last leaves_ of them are leaves.
  std::vector<Box> nodes_;
  uint32_t leaves_ = 1;
};

}  // namespace firmtouch::tools
