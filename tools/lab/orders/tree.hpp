#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/mesh/view.hpp"
#include "lab/orders/kinds.hpp"

namespace firmtouch::lab::orders {

/// A node: the boxes of its children, and where they are (as mesh::Node has it). Of four ways some
/// may be empty; those come last.
template <class BoxType, class QueryType, class FarQueryType, uint32_t kWaysOf>
struct Kind {
  using Box = BoxType;
  using Query = QueryType;
  using FarQuery = FarQueryType;  // where that refuses a point
  static constexpr uint32_t kWays = kWaysOf;
  struct Node {
    Box box[kWays];
    uint32_t child[kWays];
  };
};
using GridKind = Kind<GridBox, GridQuery, FarGridQuery, 2>;
using FloatKind = Kind<FloatBox, FloatQuery, FloatQuery, 2>;
using WideKind = Kind<GridBox, GridQuery, FarGridQuery, 4>;
using OrientedKind = Kind<OrientedBox, OrientedQuery, OrientedQuery, 2>;

constexpr uint32_t kNoChild = mesh::kLeafBit;  // a leaf of no triangles

template <class K>
struct Tree {
  const mesh::View* mesh = nullptr;
  core::Span<const typename K::Node> nodes;
  // Of each child of each node: the vertex nearest its box's centre.
  core::Span<const uint32_t> middle;
};

}  // namespace firmtouch::lab::orders
