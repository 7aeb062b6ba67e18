#include "surface/box_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace firmtouch::tools {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr Box kEmpty{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

// 21 bits, each followed by two zeros.
uint64_t spread(uint64_t bits) {
  bits = (bits | bits << 32) & 0x1F00000000FFFFull;
  bits = (bits | bits << 16) & 0x1F0000FF0000FFull;
  bits = (bits | bits << 8) & 0x100F00F00F00F00Full;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3ull;
  return (bits | bits << 2) & 0x1249249249249249ull;
}

uint64_t cell(double value, double low, double high) {
  const double share = high > low ? (value - low) / (high - low) : 0;
  return static_cast<uint64_t>(std::min(std::max(share, 0.0), 1.0) * 2097151.0);
}

uint64_t morton(const Box& box, const Box& all) {
  const Point middle = (box.low + box.high) * 0.5;
  return spread(cell(middle.x, all.low.x, all.high.x)) |
         spread(cell(middle.y, all.low.y, all.high.y)) << 1 |
         spread(cell(middle.z, all.low.z, all.high.z)) << 2;
}

}  // namespace

void grow(Box& box, const Box& by) {
  box.low = {std::min(box.low.x, by.low.x), std::min(box.low.y, by.low.y),
             std::min(box.low.z, by.low.z)};
  box.high = {std::max(box.high.x, by.high.x), std::max(box.high.y, by.high.y),
              std::max(box.high.z, by.high.z)};
}

BoxTree::BoxTree(std::vector<Box> items) : items_(std::move(items)) {
  Box all = kEmpty;
  for (const Box& item : items_) grow(all, item);
  std::vector<std::pair<uint64_t, uint32_t>> order(items_.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = {morton(items_[i], all), i};
  std::sort(order.begin(), order.end());
  order_.reserve(order.size());
  for (const auto& [code, number] : order) order_.push_back(number);
  std::vector<Box> ordered(items_.size());
  for (size_t i = 0; i < ordered.size(); ++i) ordered[i] = items_[order_[i]];
  items_ = std::move(ordered);
  while (size_t{leaves_} * kLeafItems < items_.size()) leaves_ *= 2;
  nodes_.assign(2 * size_t{leaves_} - 1, kEmpty);
  for (size_t i = 0; i < items_.size(); ++i) grow(nodes_[leaves_ - 1 + i / kLeafItems], items_[i]);
  for (size_t n = leaves_ - 1; n-- > 0;) {
    grow(nodes_[n], nodes_[2 * n + 1]);
    grow(nodes_[n], nodes_[2 * n + 2]);
  }
}

void BoxTree::overlaps(const Box& box, std::vector<uint32_t>& found) const {
  uint32_t stack[64];  // one a level and one more; there are at most 32 levels
  uint32_t size = 0;
  if (overlap(nodes_[0], box)) stack[size++] = 0;
  while (size > 0) {
    const uint32_t node = stack[--size];
    if (node + 1 < leaves_) {
      if (overlap(nodes_[2 * node + 2], box)) stack[size++] = 2 * node + 2;
      if (overlap(nodes_[2 * node + 1], box)) stack[size++] = 2 * node + 1;
      continue;
    }
    const size_t first = size_t{node + 1 - leaves_} * kLeafItems;
    for (size_t i = first; i < std::min(first + kLeafItems, items_.size()); ++i) {
      if (overlap(items_[i], box)) found.push_back(order_[i]);
    }
  }
}

}  // namespace firmtouch::tools
