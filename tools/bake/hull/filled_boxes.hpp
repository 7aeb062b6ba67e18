#pragma once
#include <functional>
#include <vector>

#include "firmtouch/hull/vertices.hpp"

namespace firmtouch::tools {

/// The box whose 256ths are the unit of a node's box: its parent's, or the whole.
enum class BoxesWithin { kParent, kWhole };

/// The boxes of a tree whose levels are filled from the left, `a_leaf` items a leaf in their order,
/// each rounded outward; the root's parent is `whole`.
std::vector<hull::NodeBox> filled_boxes(uint32_t items, uint32_t a_leaf, BoxesWithin within,
                                        const hull::Box& whole,
                                        const std::function<hull::Box(uint32_t item)>& box_of);

/// An order of items in which those that such a tree puts together lie together: parted across one
/// of thirteen directions, that which leaves the two boxes the least surface. Deterministic.
std::vector<uint32_t> filled_order(const std::vector<hull::Box>& items, uint32_t a_leaf);

/// `into` grown by `box`.
void grow(hull::Box& into, const hull::Box& box);
hull::Box box_of_point(math::Vec3 p_m);

}  // namespace firmtouch::tools
