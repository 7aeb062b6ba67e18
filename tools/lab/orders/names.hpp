#pragma once
#include "lab/orders/orders.hpp"

namespace firmtouch::lab::orders {

/// Grid, float, wide, oriented.
inline constexpr const char* kKindNames[] = {"16-bit AABB", "float AABB", "4-wide 16-bit",
                                             "oriented"};

constexpr const char* name_of(Order order) {
  return order == Order::kDepthFirst  ? "depth-first"
         : order == Order::kBestFirst ? "best-first"
                                      : "breadth-first";
}

constexpr const char* name_of(Upper upper) {
  return upper == Upper::kNone        ? "triangles"
         : upper == Upper::kVertex    ? "stored vertex"
         : upper == Upper::kFarCorner ? "farthest corner"
                                      : "min-max";
}

}  // namespace firmtouch::lab::orders
