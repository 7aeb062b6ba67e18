#include "bake/curve/curve_tree.hpp"

#include <algorithm>
#include <array>

#include "bake/tree/left_filled.hpp"
#include "bake/tree/widest_axis.hpp"
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

void place_samples(std::vector<Item>& items, std::vector<uint32_t>& tree) {
  std::vector<Range> open{{0, 0, static_cast<uint32_t>(items.size())}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const uint32_t axis =
        widest_axis(items, range.begin, range.end, [](const Item& i) { return i.at_m; });
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
