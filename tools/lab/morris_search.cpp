#include "lab/morris_search.hpp"

#include <algorithm>
#include <limits>

namespace firmtouch::tools {
namespace {

// To the farthest corner: no point of the box is farther.
float farthest2(const FloatBox& box, const std::array<float, 3>& p) {
  float sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const float far = std::max(p[k] - box.low[k], box.high[k] - p[k]);
    sum += far * far;
  }
  return sum;
}

}  // namespace

MorrisSearch::MorrisSearch(const TriangleTree& tree, const Options& options)
    : tree_(tree), options_(options), parents_(tree.nodes().size(), kNoFace) {
  for (uint32_t n = 0; n < tree.nodes().size(); ++n) {
    const TriangleTree::Node& node = tree.nodes()[n];
    if (node.count == 0) parents_[node.first] = parents_[node.first + 1] = n;
  }
}

uint32_t MorrisSearch::nearest(const std::array<float, 3>& p) {
  least2_ = upper2_ = std::numeric_limits<float>::max();
  to_descend_.clear();
  if (options_.is_seeded && best_node_ != kNoFace) {
    uint32_t seed = best_node_;
    for (uint32_t i = 0; i < options_.ascend && parents_[seed] != kNoFace; ++i)
      seed = parents_[seed];
    to_descend_.push_back(seed);
    while (!to_descend_.empty()) {
      const uint32_t node = to_descend_.front();
      to_descend_.pop_front();
      look_at(node, p);
    }
  }
  to_descend_.push_back(0);
  while (!to_descend_.empty()) {
    const uint32_t node = to_descend_.front();
    to_descend_.pop_front();
    look_at(node, p);
  }
  return best_;
}

void MorrisSearch::look_at(uint32_t index, const std::array<float, 3>& p) {
  ++boxes_read_;
  const TriangleTree::Node& node = tree_.nodes()[index];
  if (node.count != 0) {
    const float found2 = tree_.distance2(p, node.first);
    if (!(found2 < least2_)) return;
    least2_ = found2;
    upper2_ = std::min(upper2_, found2);
    best_ = node.first;
    best_node_ = index;
    return;
  }
  if (gap2(node.box, p, p) > upper2_) return;
  upper2_ = std::min(upper2_, farthest2(node.box, p));
  if (options_.depth_first) {
    to_descend_.push_front(node.first);
    to_descend_.push_front(node.first + 1);
  } else {
    to_descend_.push_back(node.first);
    to_descend_.push_back(node.first + 1);
  }
}

}  // namespace firmtouch::tools
