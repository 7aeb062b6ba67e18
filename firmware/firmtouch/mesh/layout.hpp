#pragma once
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/query/box_grid.hpp"

// How a mesh lies in an asset, byte for byte (tools/FORMAT.md says it in words). The baker writes
// these structs, the firmware reads them in place.

namespace firmtouch::mesh {

// Section types of one mesh; all share its name. Index width is part of the type.
constexpr uint32_t kHeadSection = 0x1001;
constexpr uint32_t kVerticesSection = 0x1002;  // Vertex[vertex_count]
// Triangle<uint16_t>[triangle_count], in leaf order.
constexpr uint32_t kTriangles16Section = 0x1003;
constexpr uint32_t kTriangles32Section = 0x1004;  // Triangle<uint32_t>[triangle_count]
constexpr uint32_t kNodesSection = 0x1005;        // Node[node_count], parents before children
constexpr uint32_t kParentsSection = 0x1006;      // uint32_t[node_count]
// uint32_t[vertex_count]; absent from an unsigned mesh.
constexpr uint32_t kVertexNormalsSection = 0x1007;
// uint32_t[triangle_count]: index in the imported file; for tools.
constexpr uint32_t kSourceSection = 0x1009;
constexpr uint32_t kProbesSection = 0x100A;  // query::ProbeHead and its points
// EdgeFolds[triangle_count]; absent from an unsigned mesh.
constexpr uint32_t kEdgeFoldsSection = 0x100B;
// Only in a bounded bake: uint32_t[4 * triangle_count + kLeafBoxesEnd]:
// of each leaf of two triangles or more an oriented box, eight words at word 4 * first triangle
// (math::oriented_distance2(), tools/FORMAT.md).
constexpr uint32_t kLeafBoxesSection = 0x100E;
// BoxFrame; only where the boxes are turned against the axes.
constexpr uint32_t kBoxFrameSection = 0x1010;

constexpr uint32_t kLeafBoxWords = 8;
constexpr uint32_t kLeafBoxStride = 4;  // words a triangle
constexpr uint32_t kLeafBoxesEnd =
    8;  // a box that excludes nothing, for a last leaf of one triangle
// Of a leaf without a box, words 0 and 1: nothing is farther out than this.
constexpr uint32_t kNoLeafBox = 0xFFFFFFFFu;

// A traversal keeps one entry a level. 2^24 triangles in pairs make 23 levels of a balanced tree;
// the baker's SAH trees of up to 2e6 triangles were seen to need 26. The baker refuses a deeper
// tree, and so does open().
constexpr uint32_t kMaxDepth = 40;
constexpr uint32_t kMaxTriangles = 1u << 24;
constexpr uint32_t kMaxNodes = 1u << 24;

using query::kGridMax;  // boxes lie on a grid of 15-bit coordinates

// The share of the diagonal up to which a lower bound also covers the rounding of the imported
// coordinates to float32: a model about two diagonals from its origin. One farther off is certified
// as it was rounded.
constexpr float kMaxRounding = 1.5e-7f;

struct Head {
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t node_count;
  uint32_t depth;      // levels of nodes, leaves not counted
  uint32_t is_signed;  // 1: closed and outward, the side of a point is defined; 0: distance only
  float low_m[3];      // bounding box of the vertices, exact
  float high_m[3];
  float diagonal_m;  // of that box, rounded down
  // Grid coordinate 0; the grid covers twice the extent about the box's centre.
  float grid_low_m[3];
  float cell_m;          // a power of two, so that metres to cells rounds only once
  float longest_edge_m;  // at least that of all triangles in float32
  // By how much importing it to float32 and turning slivers may have moved the surface; at most
  // kMaxRounding diagonals.
  float rounding_m;
};
static_assert(sizeof(Head) == 72 && alignof(Head) == 4);
static_assert(offsetof(Head, low_m) == 20 && offsetof(Head, grid_low_m) == 48);

struct Vertex {
  float x_m, y_m, z_m;
};
static_assert(sizeof(Vertex) == 12);

/// The frame of the boxes of a turned mesh: p is at (axis[k] . (p - centre)) on axis k of the grid.
/// The axes are square to each other and a little shorter than units, so that no distance grows by
/// their rounding.
struct BoxFrame {
  float centre_m[3];
  float axis[3][3];
};
static_assert(sizeof(BoxFrame) == 48);
constexpr float kAxisLength2 = 1.0f - 1.5f * 0x1p-15f;  // squared

/// Corners in outward order, rotated so that edge 0 (corner 0 to 1) is the longest: the solver
/// needs that.
template <class Index>
struct Triangle {
  Index corner[3];
};
static_assert(sizeof(Triangle<uint16_t>) == 6 && sizeof(Triangle<uint32_t>) == 12);

/// One side of an inner node: the box of a child, box[k] = low | (32767 - high) << 16, and where
/// the child is.
struct Side {
  uint32_t box[3];
  uint32_t child;
};
static_assert(sizeof(Side) == 16 && offsetof(Side, child) == 12);

/// An inner node. A place, node << 1 | slot, names a side; all sides lie 16 bytes apart.
struct Node {
  Side side[2];
};
static_assert(sizeof(Node) == 32);

// child: an inner node's index, always more than its parent's; or a leaf: bit 31, count << 28 for 0
// to 7 triangles, first triangle in the low 28 bits. Only the root of a mesh of one triangle has a
// leaf of no triangles.
constexpr uint32_t kLeafBit = 0x80000000u;
constexpr bool is_leaf(uint32_t child) { return (child & kLeafBit) != 0; }
constexpr uint32_t leaf_count(uint32_t child) { return (child >> 28) & 7u; }
constexpr uint32_t leaf_first(uint32_t child) { return child & 0x0FFFFFFFu; }
constexpr uint32_t make_leaf(uint32_t first, uint32_t count) {
  return kLeafBit | (count << 28) | first;
}

// parents[i]: depth of node i (root 0) << 25 | its parent's index << 1 | which child of it. Root:
// 0.
constexpr uint32_t slot_of(uint32_t word) { return word & 0x01FFFFFFu; }  // parent << 1 | slot
constexpr uint32_t parent_of(uint32_t word) { return slot_of(word) >> 1; }
constexpr uint32_t which_of(uint32_t word) { return word & 1u; }
constexpr uint32_t depth_of(uint32_t word) { return word >> 25; }
constexpr uint32_t make_parent(uint32_t parent, uint32_t which, uint32_t depth) {
  return (depth << 25) | (parent << 1) | which;
}

/// The pseudonormal of each edge (edge k runs from corner k to k + 1), in the triangle's own frame:
/// with n the face's unit normal, m the unit vector in its plane, across the edge and outward, s =
/// fold / 127.05: n (1 - |s|) + m s.
///
/// The last codes, +-127, are 3.9e-4 rad short of m. A normal perpendicular to its own face would
/// decide no sign; these still decide it for a face that is folded back to within 7e-4 rad.
struct EdgeFolds {
  int8_t fold[3];
};
static_assert(sizeof(EdgeFolds) == 3 && alignof(EdgeFolds) == 1);
constexpr int32_t kMaxFold = 127;
constexpr float kFoldsPerUnit = 127.05f;

// A vertex's pseudonormal: octahedral, u in the low and v in the high 16 bits, each (value + 32767)
// of -32767..32767.

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The head is absent or not 72 bytes long, or the box frame not 48.
  kRuleHeadSize = 101,
  // There are no vertices, or the vertex section does not hold vertex_count of them.
  kRuleVertices = 102,
  // There is not exactly one triangle section (0). It holds no triangles, more than 2^24, or not
  // triangle_count of them (1).
  kRuleTriangles = 103,
  // There are no nodes or more than 2^24, or the sections of nodes and parents do not hold
  // node_count of them.
  kRuleNodes = 104,
  // is_signed is above 1, or there are not one pseudonormal a vertex and three folds a triangle
  // exactly if it is 1.
  kRuleSigned = 105,
  // The head is not sound: rounding below 0 or above 1.5e-7 of the diagonal (0); cell no power of
  // two from 2^-95 to 2^65 (1); box inverted or beyond 1e7 m (2); grid with less than 0.124
  // extents free about the box (3); grid over more than 2.6 extents, or extent below 1e-9 m (4);
  // diagonal above the box's, or more than 2^-20 of it below (5); longest edge not above 0, or
  // above 1.001 diagonals (6). With a box frame: extent below 1e-9 m, centre beyond 1e7 m, or a
  // product of two axes more than 2^-18 from 0, or of one with itself from 1 - 1.5 * 2^-15 (7);
  // less than 3,200 cells free about the root's boxes (3).
  kRuleHead = 106,
  // The depth is 0, above 40 or not the tree's.
  kRuleDepth = 107,
  // A vertex is outside the head's box, or NaN.
  kRuleVertexOutsideBox = 110,
  // No vertex touches a side of the head's box.
  kRuleBoxNotTouched = 111,
  // The code of a vertex pseudonormal is above 65534.
  kRuleVertexNormal = 112,
  // The box of a child is inverted or off the grid.
  kRuleNodeBox = 120,
  // The boxes in a node are not inside the box of the node.
  kRuleBoxOutsideParent = 121,
  // A child is not a later node, or its parent word names another node.
  kRuleChild = 122,
  // The root's parent word is not 0, or a node is no child of another.
  kRuleParent = 123,
  // A leaf is empty, does not begin where the previous one ended, or exceeds the triangles. Only
  // the second child of the only node may be empty.
  kRuleLeaf = 124,
  // No leaf holds some of the triangles.
  kRuleTrianglesLeft = 125,
  // A corner is not a vertex.
  kRuleCorner = 126,
  // A triangle is not inside the box of its leaf.
  kRuleTriangleOutsideLeaf = 127,
  // Edge 0 of a triangle is not its longest, or is shorter than 1e-12 m.
  kRuleLongestEdgeFirst = 128,
  // A triangle is thinner than 1e-10 of its longest edge, or lower than 1e-18 m.
  kRuleThinTriangle = 129,
  // An edge fold is -128.
  kRuleFold = 130,
  // Edge 0 of a triangle is longer than the head's longest_edge_m.
  kRuleEdgeAboveLongest = 131,
  // The leaf boxes are not 16 bytes a triangle and 32 (0), or the last eight words are not those of
  // no box (1).
  kRuleLeafBoxesSize = 136,
  // The words after a leaf's box, or instead of one, are not as they must be.
  kRuleLeafBoxWords = 137,
  // The axes of a box may lengthen a vector: the sizes of one axis' products with all three add
  // up to more than 2^30.
  kRuleLeafBoxAxes = 138,
  // A triangle is not inside its leaf box, or more than 32,766 half cells from its centre on an
  // axis.
  kRuleTriangleOutsideLeafBox = 139,
};

}  // namespace firmtouch::mesh
