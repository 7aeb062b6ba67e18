#pragma once
#include <functional>
#include <vector>

#include "firmtouch/hull/vertices.hpp"

namespace firmtouch::tools {

/// The boxes of a tree whose levels are filled from the left, `a_leaf` items a leaf in their order,
/// each box in 256ths of its parent's, rounded outward; the root's within `whole`.
std::vector<hull::NodeBox> filled_boxes(uint32_t items, uint32_t a_leaf, const hull::Box& whole,
                                        const std::function<hull::Box(uint32_t item)>& box_of);

/// An order of items in which those that such a tree puts together lie together: halved along the
/// longest side of what is halved. Deterministic.
std::vector<uint32_t> filled_order(const std::vector<math::Vec3>& middles_m, uint32_t a_leaf);

/// `into` grown by `box`.
void grow(hull::Box& into, const hull::Box& box);
hull::Box box_of_point(math::Vec3 p_m);

}  // namespace firmtouch::tools
