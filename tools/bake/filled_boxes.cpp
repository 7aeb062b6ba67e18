#include "bake/filled_boxes.hpp"

#include <algorithm>
#include <numeric>

#include "bake/left_filled.hpp"
#include "firmtouch/hull/box_descent.hpp"

namespace firmtouch::tools {
namespace {

float coordinate(math::Vec3 v, uint32_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

// The largest step that keeps the child inside: guessed, then mended by the reader's own floats.
hull::NodeBox within(const hull::Box& parent, const hull::Box& child) {
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

class Halver {
 public:
  Halver(const std::vector<math::Vec3>& middles_m, uint32_t a_leaf)
      : middles_m_(middles_m), a_leaf_(a_leaf), order_(middles_m.size()) {
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
      const uint32_t left = (first_size(hull::nodes_for(part.leaves)) + 1) / 2;
      const uint32_t middle = std::min(part.first + left * a_leaf_, part.end);
      halve(part.first, middle, part.end);
      parts.push_back({part.first, middle, left});
      parts.push_back({middle, part.end, part.leaves - left});
    }
    return order_;
  }

 private:
  void halve(uint32_t first, uint32_t middle, uint32_t end) {
    hull::Box box = box_of_point(middles_m_[order_[first]]);
    for (uint32_t i = first; i < end; ++i) grow(box, box_of_point(middles_m_[order_[i]]));
    uint32_t axis = 0;
    for (uint32_t k = 1; k < 3; ++k)
      if (box.high_m[k] - box.low_m[k] > box.high_m[axis] - box.low_m[axis]) axis = k;
    const auto is_before = [&](uint32_t a, uint32_t b) {
      const float one = coordinate(middles_m_[a], axis), other = coordinate(middles_m_[b], axis);
      return one < other || (!(other < one) && a < b);
    };
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     is_before);
    // What nth_element leaves in no order: sorted, so that every library gives the same.
    std::sort(order_.begin() + first, order_.begin() + middle, is_before);
    std::sort(order_.begin() + middle, order_.begin() + end, is_before);
  }

  const std::vector<math::Vec3>& middles_m_;
  uint32_t a_leaf_;
  std::vector<uint32_t> order_;
};

}  // namespace

hull::Box box_of_point(math::Vec3 p_m) { return {{p_m.x, p_m.y, p_m.z}, {p_m.x, p_m.y, p_m.z}}; }

void grow(hull::Box& into, const hull::Box& box) {
  for (uint32_t k = 0; k < 3; ++k) {
    into.low_m[k] = std::min(into.low_m[k], box.low_m[k]);
    into.high_m[k] = std::max(into.high_m[k], box.high_m[k]);
  }
}

std::vector<hull::NodeBox> filled_boxes(uint32_t items, uint32_t a_leaf, const hull::Box& whole,
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
    const hull::Box& parent = node == 0 ? whole : stored[(node - 1) / 2];
    boxes[node] = within(parent, exact[node]);
    stored[node] = hull::child_box(parent, boxes[node]);
  }
  return boxes;
}

std::vector<uint32_t> filled_order(const std::vector<math::Vec3>& middles_m, uint32_t a_leaf) {
  return Halver(middles_m, a_leaf).run();
}

}  // namespace firmtouch::tools
