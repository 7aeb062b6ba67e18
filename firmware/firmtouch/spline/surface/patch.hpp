#pragma once
// The parts of a surface's piece, which its levels imply.
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/layout.hpp"

namespace firmtouch::spline {

/// A part of a surface's piece: the piece halved `depth` times, its longer axis first while it has
/// more halvings to come, then u and v in turn.
struct Patch {
  uint32_t piece, depth, u, v;  // from where u and v are least
};

/// How many of a part's halvings were of u and of v.
struct Halvings {
  uint32_t u, v;
};
inline Halvings halvings_of(const Piece& piece, uint32_t depth) {
  const uint32_t level_u = piece.level_u, level_v = piece.level_v;
  if (level_u >= level_v) {
    const uint32_t first = level_u - level_v;
    if (depth <= first) return {depth, 0};
    return {first + (depth - first + 1) / 2, (depth - first) / 2};
  }
  const uint32_t first = level_v - level_u;
  if (depth <= first) return {0, depth};
  return {(depth - first + 1) / 2, first + (depth - first) / 2};
}
/// The halvings to a piece's cells.
inline Halvings cell_levels(const Piece& piece, const Grid& grid) {
  const uint32_t u = piece.level_u, v = piece.level_v, cell = grid.cell_level;
  return {u < cell ? u : cell, v < cell ? v : cell};
}
/// The number of the cell that holds a leaf, by the leaf's place in the piece.
inline uint32_t cell_of(const Piece& piece, const Grid& grid, uint32_t u, uint32_t v) {
  const Halvings cell = cell_levels(piece, grid);
  return grid.first_cell +
         ((v >> (piece.level_v - cell.v)) << cell.u | u >> (piece.level_u - cell.u));
}

/// Whether the next halving is of u.
inline bool halves_u(const Piece& piece, const Halvings& made) {
  return piece.level_u - made.u >= piece.level_v - made.v;
}

inline Patch parent_of(const Piece& piece, const Patch& p) {
  const bool was_u = halves_u(piece, halvings_of(piece, p.depth - 1));
  return {p.piece, p.depth - 1, was_u ? p.u >> 1 : p.u, was_u ? p.v : p.v >> 1};
}
inline Patch sibling_of(const Piece& piece, const Patch& p) {
  const bool was_u = halves_u(piece, halvings_of(piece, p.depth - 1));
  return {p.piece, p.depth, was_u ? p.u ^ 1u : p.u, was_u ? p.v : p.v ^ 1u};
}
inline uint32_t radius_of(const Grid& grid, const Patch& p, const Halvings& made) {
  return 2 * grid.first_leaf - p.piece + (1u << p.depth) - 1u + (p.v << made.u | p.u);
}

inline uint32_t overlap_of(const Grid& grid, const Patch& p, const Halvings& made) {
  return grid.first_leaf - p.piece + (1u << p.depth) - 1u + (p.v << made.u | p.u);
}

/// centre + x a + y b + x y twist for x and y from -1 to 1, in metres from the piece's origin:
/// without rounding.
struct Quad {
  math::Vec3 centre, a, b, twist;
};

}  // namespace firmtouch::spline
