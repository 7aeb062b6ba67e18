#include "bake/hull/filled_boxes.hpp"

#include <algorithm>
#include <cfloat>
#include <numeric>

#include "bake/tree/left_filled.hpp"
#include "firmtouch/hull/box_descent.hpp"

namespace firmtouch::tools {
namespace {

// The largest step that keeps the child inside: guessed, then mended by the reader's own floats.
hull::NodeBox reported_within(const hull::Box& parent, const hull::Box& child) {
  hull::NodeBox node{};
  for (uint32_t k = 0; k < 3; ++k) {
    const float side = parent.high_m[k] - parent.low_m[k];
    const auto steps = [side](float distance) {
      const float guess = side > 0 ? distance / side * 256.0f : 0.0f;
      return static_cast<uint8_t>(std::clamp(guess, 0.0f, 255.0f));
    };
    node.low[k] = steps(child.low_m[k] - parent.low_m[k]);
    node.high[k] = steps(parent.high_m[k] - child.high_m[k]);
    while (node.low[k] > 0 && !(hull::child_box(parent, node).low_m[k] <= child.low_m[k]))
      --node.low[k];
    while (node.high[k] > 0 && !(hull::child_box(parent, node).high_m[k] >= child.high_m[k]))
      --node.high[k];
  }
  return node;
}

// Towards a cube's faces, edges and corners.
constexpr int kDirections[13][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                    {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                    {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};

double surface_of(const hull::Box& box) {
  double side[3];
  for (uint32_t k = 0; k < 3; ++k)
    side[k] = static_cast<double>(box.high_m[k]) - static_cast<double>(box.low_m[k]);
  return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

class Parter {
 public:
  Parter(const std::vector<hull::Box>& items, uint32_t a_leaf)
      : items_(items), a_leaf_(a_leaf), order_(items.size()), place_(items.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<uint32_t> run() {
    const uint32_t items = static_cast<uint32_t>(order_.size());
    struct Part {
      uint32_t first, end, leaves;
    };
    std::vector<Part> parts{{0, items, hull::leaves_for(items, a_leaf_)}};
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      if (part.leaves < 2) continue;
      const uint32_t left = left_of(part.leaves);
      const uint32_t middle = std::min(part.first + left * a_leaf_, part.end);
      cut(part.first, middle, part.end, part.leaves);
      parts.push_back({part.first, middle, left});
      parts.push_back({middle, part.end, part.leaves - left});
    }
    return order_;
  }

 private:
  using Order = std::vector<uint32_t>;

  static uint32_t left_of(uint32_t leaves) { return (first_size(hull::nodes_for(leaves)) + 1) / 2; }

  // The two sides of a tree may hold unequal numbers, so each direction is tried both ways. Looks
  // one cut ahead: of parts of many items that would take long and gain little.
  void cut(uint32_t first, uint32_t middle, uint32_t end, uint32_t leaves) {
    constexpr uint32_t kMaxWindow = 4096;
    Order tried(order_.begin() + first, order_.begin() + end), best;
    double least = 0;
    for (const int(&direction)[3] : kDirections) {
      for (const double sign : {1.0, -1.0}) {
        sort(tried, direction, sign);
        const auto border = tried.begin() + (middle - first);
        double cost = cost_of(tried.begin(), border) + cost_of(border, tried.end());
        if (end - first <= kMaxWindow) {
          const uint32_t left = left_of(leaves);
          cost += min_below({tried.begin(), border}, left) +
                  min_below({border, tried.end()}, leaves - left);
        }
        if (best.empty() || cost < least) {
          least = cost;
          best = tried;
        }
      }
    }
    std::copy(best.begin(), best.end(), order_.begin() + first);
  }
  void sort(Order& items, const int (&direction)[3], double sign) {
    for (const uint32_t item : items) place_[item] = sign * place(items_[item], direction);
    std::sort(items.begin(), items.end(), [this](uint32_t a, uint32_t b) {
      return place_[a] < place_[b] || (!(place_[b] < place_[a]) && a < b);
    });
  }
  // The least cost of the two parts of a part.
  double min_below(Order items, uint32_t leaves) {
    if (leaves < 2) return 0;
    const size_t middle = std::min<size_t>(left_of(leaves) * a_leaf_, items.size());
    double least = DBL_MAX;
    for (const int(&direction)[3] : kDirections) {
      for (const double sign : {1.0, -1.0}) {
        sort(items, direction, sign);
        const auto border = items.begin() + static_cast<std::ptrdiff_t>(middle);
        least = std::min(least, cost_of(items.begin(), border) + cost_of(border, items.end()));
      }
    }
    return least;
  }
  static double place(const hull::Box& item, const int (&direction)[3]) {
    double sum = 0;
    for (uint32_t k = 0; k < 3; ++k)
      sum +=
          direction[k] * (static_cast<double>(item.low_m[k]) + static_cast<double>(item.high_m[k]));
    return sum;
  }
  double cost_of(Order::const_iterator from, Order::const_iterator to) const {
    if (from == to) return 0;
    hull::Box box = items_[*from];
    for (auto at = from; at != to; ++at) grow(box, items_[*at]);
    return surface_of(box) * static_cast<double>(to - from);
  }

  const std::vector<hull::Box>& items_;
  uint32_t a_leaf_;
  Order order_;
  std::vector<double> place_;  // of each item along the direction being tried
};

}  // namespace

hull::Box box_of_point(math::Vec3 p_m) { return {{p_m.x, p_m.y, p_m.z}, {p_m.x, p_m.y, p_m.z}}; }

void grow(hull::Box& into, const hull::Box& box) {
  for (uint32_t k = 0; k < 3; ++k) {
    into.low_m[k] = std::min(into.low_m[k], box.low_m[k]);
    into.high_m[k] = std::max(into.high_m[k], box.high_m[k]);
  }
}

std::vector<hull::NodeBox> filled_boxes(uint32_t items, uint32_t a_leaf, BoxesWithin within,
                                        const hull::Box& whole,
                                        const std::function<hull::Box(uint32_t)>& box_of) {
  const uint32_t nodes = hull::nodes_for(hull::leaves_for(items, a_leaf));
  const hull::FilledTree tree(nodes);
  std::vector<hull::Box> exact(nodes), stored(nodes);
  for (uint32_t node = nodes; node-- > 0;) {
    if (!tree.is_leaf(node)) {
      exact[node] = exact[2 * node + 1];
      grow(exact[node], exact[2 * node + 2]);
      continue;
    }
    const uint32_t first = tree.leaf(node) * a_leaf, end = std::min(first + a_leaf, items);
    exact[node] = box_of(first);
    for (uint32_t i = first + 1; i < end; ++i) grow(exact[node], box_of(i));
  }
  std::vector<hull::NodeBox> boxes(nodes);
  for (uint32_t node = 0; node < nodes; ++node) {
    const bool is_nested = node != 0 && within == BoxesWithin::kParent;
    const hull::Box& parent = is_nested ? stored[(node - 1) / 2] : whole;
    boxes[node] = reported_within(parent, exact[node]);
    stored[node] = hull::child_box(parent, boxes[node]);
  }
  return boxes;
}

std::vector<uint32_t> filled_order(const std::vector<hull::Box>& items, uint32_t a_leaf) {
  return Parter(items, a_leaf).run();
}

}  // namespace firmtouch::tools
