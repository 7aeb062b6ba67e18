#pragma once
// Nodes of a surface's tree, for .cpp files of this module only.
#include "firmtouch/spline/surface/patch.hpp"

namespace firmtouch::spline {

/// A node in one word: a part of a piece, or kUpper + i for inner node i of the tree over the
/// pieces. No piece has the number of kUpper: there are at most kMaxPatches.
constexpr uint32_t kUpper = 0xFFFF0000u;
/// Of a part bits 16 to 31 are the piece, bits 7 to 13 and 0 to 6 its u and v, each with a 1 before
/// their binary digits: as many as the halvings made.
/// Bit 14 is free for a search's own mark of leaves and their rectangles.
constexpr uint32_t kLeafMark = 1u << 14;
constexpr uint32_t kNextU = 1u << 7, kNextV = 1;  // to the node of the part beside
constexpr uint32_t kWholePiece = kNextU | kNextV;

/// A part's node taken apart.
struct PatchNode {
  uint32_t u, v;            // with the 1 before
  uint32_t made_u, made_v;  // halvings
  uint32_t left_u, left_v;  // to a leaf
};
inline uint32_t digits_of(uint32_t marked) {
  return 31u - static_cast<uint32_t>(__builtin_clz(marked));
}
inline PatchNode apart(const Piece& piece, uint32_t node) {
  const uint32_t u = (node >> 7) & 127u, v = node & 127u;
  const uint32_t made_u = digits_of(u), made_v = digits_of(v);
  return {u, v, made_u, made_v, piece.level_u - made_u, piece.level_v - made_v};
}
/// Whether the last halving was of u: by the order of halvings.
inline bool was_halved_u(const PatchNode& p) {
  return p.made_u != 0 && (p.left_u < p.left_v || p.made_v == 0);
}
inline uint32_t whole_of(uint32_t node, const PatchNode& p) {
  return was_halved_u(p) ? node - ((p.u - (p.u >> 1)) << 7) : node - (p.v - (p.v >> 1));
}
inline uint32_t node_of_leaf(const Piece& piece, uint32_t number, uint32_t u, uint32_t v) {
  return number << 16 | ((1u << piece.level_u) + u) << 7 | ((1u << piece.level_v) + v);
}
inline uint32_t node_of(uint32_t number, const PatchNode& p) {
  return number << 16 | p.u << 7 | p.v;
}

}  // namespace firmtouch::spline
