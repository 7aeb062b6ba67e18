#pragma once
// Triangles that lie side by side in memory (mesh/ahead.hpp). For the library's own translation units.

#include "firmtouch/math/isa_lanes.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/ahead.hpp"

namespace firmtouch::mesh {

// Three of the rows of `count` floats, side by side or one by one.
template <class Float>
[[gnu::always_inline]] static inline math::Lanes<Float> lanes_of_rows(const float* rows, size_t k,
                                                                      size_t count) {
  return {math::lanes_from<Float>(rows + k * count),
          math::lanes_from<Float>(rows + (k + 1) * count),
          math::lanes_from<Float>(rows + (k + 2) * count)};
}
[[gnu::always_inline]] static inline math::Vec3 one_of_rows(const float* rows, size_t k,
                                                            size_t count) {
  return {rows[k * count], rows[(k + 1) * count], rows[(k + 2) * count]};
}

/// Triangles that lie side by side: a block, or of one a leaf. Lanes that they leave over hold what
/// comes next.
struct Lined {
  const Ahead& ahead;
  Block of;
  uint32_t first, count;

  Lined(const Ahead& from, const Block& block)
      : ahead(from), of(block), first(of.first), count(of.count) {}
  Lined(const Ahead& from, uint32_t leaf)
      : ahead(from), of(lined_block(leaf)), first(lined_first(leaf)), count(leaf_count(leaf)) {}
  uint32_t asked() const { return (1u << count) - 1u; }
  /// Where the first row of those of `rows` a triangle begins.
  const float* row(const float* floats, uint32_t rows) const {
    return floats + size_t{rows} * of.first + (first - of.first);
  }
};

/// Their corners.
template <class Float>
struct LinedCorners {
  const float* row;
  size_t stride;

  explicit LinedCorners(const Lined& lined)
      : row(lined.row(lined.ahead.corners, kRowsOfCorners)), stride(lined.of.count) {}
  math::Lanes<Float> corner(size_t k) const { return lanes_of_rows<Float>(row, 3 * k, stride); }
  math::Vec3 corner(size_t k, uint32_t lane) const {
    return one_of_rows(row + lane, 3 * k, stride);
  }
};

}  // namespace firmtouch::mesh
