#include "bake/curve/curve_tree.hpp"

#include <algorithm>
#include <array>

#include "bake/tree/left_filled.hpp"
#include "firmtouch/curve/derived.hpp"

namespace firmtouch::tools {
namespace {

// A sample with its coordinates beside its index: selection walks memory in order.
struct Item {
  std::array<float, 3> at_m;
  uint32_t sample;
};

struct Range {
  uint32_t node;
  uint32_t begin, end;
};

uint32_t widest_axis(const std::vector<Item>& items, uint32_t begin, uint32_t end) {
  std::array<float, 3> low = items[begin].at_m, high = low;
  for (uint32_t i = begin + 1; i < end; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], items[i].at_m[k]);
      high[k] = std::max(high[k], items[i].at_m[k]);
    }
  }
  size_t widest = 0;
  for (size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  return static_cast<uint32_t>(widest);
}

void place_samples(std::vector<Item>& items, std::vector<uint32_t>& tree) {
  std::vector<Range> open{{0, 0, static_cast<uint32_t>(items.size())}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const uint32_t axis = widest_axis(items, range.begin, range.end);
    const uint32_t middle = range.begin + first_size(range.end - range.begin);
    std::nth_element(items.begin() + range.begin, items.begin() + middle, items.begin() + range.end,
                     [axis](const Item& a, const Item& b) {
                       if (a.at_m[axis] < b.at_m[axis]) return true;
                       if (b.at_m[axis] < a.at_m[axis]) return false;
                       return a.sample < b.sample;
                     });
    tree[range.node] = curve::make_node(items[middle].sample, axis);
    const uint32_t child = curve::first_child(range.node);
    if (middle > range.begin) open.push_back({child, range.begin, middle});
    if (middle + 1 < range.end) open.push_back({child + 1, middle + 1, range.end});
  }
}

}  // namespace

std::vector<uint32_t> build_curve_tree(const std::vector<curve::Sample>& samples) {
  const auto count = static_cast<uint32_t>(samples.size());
  std::vector<Item> items(count);
  for (uint32_t i = 0; i < count; ++i)
    items[i] = {{samples[i].x_m, samples[i].y_m, samples[i].z_m}, i};
  std::vector<uint32_t> tree(count);
  place_samples(items, tree);
  return tree;
}

}  // namespace firmtouch::tools
