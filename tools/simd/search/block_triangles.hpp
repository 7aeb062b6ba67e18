#pragma once
// Triangles stored as structure of arrays (simd/wide_tree.hpp).

#include "simd/search/vectors.hpp"
#include "simd/wide_tree.hpp"

namespace firmtouch::simd {

// Vectors from three of the arrays of `count` floats: of all lanes, or of one.
[[gnu::always_inline]] static inline Lanes vectors_of(const float* arrays, size_t k, size_t count) {
  return {lanes_from(arrays + k * count), lanes_from(arrays + (k + 1) * count),
          lanes_from(arrays + (k + 2) * count)};
}
[[gnu::always_inline]] static inline math::Vec3 vector_of(const float* arrays, size_t k,
                                                          size_t count) {
  return {arrays[k * count], arrays[(k + 1) * count], arrays[(k + 2) * count]};
}

/// The triangles of a block, or of one of its leaves. Lanes beyond them hold the next floats.
struct BlockTriangles {
  const WideTree& tree;
  Block of;
  uint32_t first, count;

  BlockTriangles(const WideTree& from, const Block& block)
      : tree(from), of(block), first(of.first), count(of.count) {}
  BlockTriangles(const WideTree& from, uint32_t leaf)
      : tree(from),
        of(wide_leaf_block(leaf)),
        first(wide_leaf_first(leaf)),
        count(leaf_count(leaf)) {}
  /// A bit for each triangle.
  uint32_t lanes() const { return (1u << count) - 1u; }
  /// The first of `arrays` arrays at the first triangle.
  const float* begin(const float* floats, uint32_t arrays) const {
    return floats + size_t{arrays} * of.first + (first - of.first);
  }
};

struct CornerArrays {
  const float* arrays;
  size_t stride;

  explicit CornerArrays(const BlockTriangles& triangles)
      : arrays(triangles.begin(triangles.tree.corners, kCornerArrays)),
        stride(triangles.of.count) {}
  Lanes corner(size_t k) const { return vectors_of(arrays, 3 * k, stride); }
  math::Vec3 corner(size_t k, uint32_t lane) const {
    return vector_of(arrays + lane, 3 * k, stride);
  }
};

}  // namespace firmtouch::simd
