#include "bake/curve_tree.hpp"

#include <algorithm>
#include <array>

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

// How many of `count` nodes of a tree filled from the left stand below its root's first child.
uint32_t first_size(uint32_t count) {
  uint32_t level = 1;  // nodes of the last level, were it full
  while (2 * level <= count) level *= 2;
  const uint32_t last = count - (level - 1), half = level / 2;
  return count == 1 ? 0 : (half - 1) + std::min(last, half);
}

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

void place_samples(std::vector<Item>& items, std::vector<curve::Node>& nodes) {
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
    nodes[range.node].place = curve::make_place(items[middle].sample, axis);
    const uint32_t child = curve::first_child(range.node);
    if (middle > range.begin) open.push_back({child, range.begin, middle});
    if (middle + 1 < range.end) open.push_back({child + 1, middle + 1, range.end});
  }
}

}  // namespace

std::vector<curve::Node> build_curve_tree(const std::vector<curve::Sample>& samples) {
  const auto count = static_cast<uint32_t>(samples.size());
  std::vector<Item> items(count);
  for (uint32_t i = 0; i < count; ++i)
    items[i] = {{samples[i].x_m, samples[i].y_m, samples[i].z_m}, i};
  std::vector<curve::Node> nodes(count);
  place_samples(items, nodes);
  for (uint32_t i = count; i-- > 0;) {  // children have higher numbers than their parent
    float reach_m = curve::own_reach_m(samples.data(), count, curve::sample_of(nodes[i].place));
    const uint32_t child = curve::first_child(i);
    for (uint32_t c = child; c < child + 2 && c < count; ++c)
      reach_m = std::max(reach_m, nodes[c].reach_m);
    nodes[i].reach_m = reach_m;
  }
  return nodes;
}

}  // namespace firmtouch::tools
