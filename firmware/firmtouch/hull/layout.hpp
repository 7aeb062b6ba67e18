#pragma once
#include <stdint.h>

// How a progressive hull lies in an asset, byte for byte (tools/FORMAT.md says it in words). It
// shares the name of its mesh, whose triangles are its finest faces.

namespace firmtouch::hull {

constexpr uint32_t kHeadSection = 0x5001;
constexpr uint32_t kVerticesSection = 0x5002;       // of collapse k: its new vertex, on the grid
constexpr uint32_t kOriginsSection = 0x5003;        // of each id: the number of its vertex
constexpr uint32_t kRecordsSection = 0x5004;        // of collapse k: its star
constexpr uint32_t kRecordOffsetsSection = 0x5005;  // uint32_t: where every eighth record begins
constexpr uint32_t kStarBoxesSection = 0x5006;      // StarBox[collapse_count]
constexpr uint32_t kBoxesSection = 0x5007;          // NodeBox: a tree over the mesh's triangles
constexpr uint32_t kBaseHullSection = 0x5008;       // the coarsest hull (hull/base_hull.hpp)
constexpr uint32_t kProbesSection = 0x5009;         // query::ProbeHead and its points

// Numbers: 0 to mesh_vertex_count - 1 are the mesh's vertices, mesh_vertex_count + k is the new one
// of collapse k. Ids: the two vertices that collapse k removes have the ids 2 k and 2 k + 1, those
// that stay to the end the others. So the id of a vertex gives the collapse that removes it,
// without a table.
constexpr uint32_t removed_by(uint32_t id) { return id >> 1; }

// Three bytes an id, at most.
constexpr uint32_t kMaxIds = 1u << 24;
constexpr uint32_t kRecordsPerOffset = 8;
// A star keeps its corners in an array.
constexpr uint32_t kMaxLink = 31;

struct Head {
  uint32_t mesh_vertex_count;
  uint32_t mesh_triangle_count;
  uint32_t collapse_count;
  uint32_t id_bytes;          // 2 or 3: of an id, a number, a triangle
  uint32_t coordinate_bytes;  // 2 or 3: of a coordinate on the grid
  uint32_t record_bytes;      // of all records
  float grid_low_m[3];        // coordinate 0; each grid point is a float32 exactly
  float cell_m;               // a power of two
  float low_m[3];             // box of all vertices, the mesh's and the hulls'
  float high_m[3];
};
static_assert(sizeof(Head) == 64 && alignof(Head) == 4);

// A record: u16 head, then ids of id_bytes each: the new vertex, the link counter-clockwise from
// outside, and the mesh's triangles in the star in the star's order.
//   head: faces of the link in bits 0 to 4, of them opposite vertex 2 k in bits 5 to 9, triangles
//   of the mesh in bits 10 to 15.
// The star: face i of the link has its corners i and i + 1 and, before `split`, vertex 2 k, else
// 2 k + 1; then (2 k, 2 k + 1, corner 0) and (2 k + 1, 2 k, corner `split`).
constexpr uint32_t record_head(uint32_t link, uint32_t split, uint32_t triangles) {
  return link | split << 5 | triangles << 10;
}
constexpr uint32_t link_of(uint32_t head) { return head & 31u; }
constexpr uint32_t split_of(uint32_t head) { return (head >> 5) & 31u; }
constexpr uint32_t triangles_of(uint32_t head) { return (head >> 10) & 63u; }
constexpr uint32_t record_size(uint32_t head, uint32_t id_bytes) {
  return 2 + id_bytes * (1 + link_of(head) + triangles_of(head));
}

/// A box about a star, as it lies from the new vertex: 6 reaches of 7 bits (below and above on x,
/// y, z) in units of the grid's cell times two to the power of the last 6 bits.
struct StarBox {
  uint8_t bits[6];
};
static_assert(sizeof(StarBox) == 6 && alignof(StarBox) == 1);
constexpr uint32_t kMaxReach = 127;

/// A box within its parent's, in 256ths of the parent's sides: from its low and from its high side.
/// The tree's levels are filled from the left, children of node i are 2 i + 1 and 2 i + 2.
struct NodeBox {
  uint8_t low[3], high[3];
};
static_assert(sizeof(NodeBox) == 6 && alignof(NodeBox) == 1);

// A leaf of the tree over the mesh holds so many triangles, of the tree over a base hull so many
// faces.
constexpr uint32_t kLeafTriangles = 4;
constexpr uint32_t kLeafFaces = 4;
constexpr uint32_t kMaxTreeDepth = 24;

constexpr uint32_t leaves_for(uint32_t items, uint32_t a_leaf) {
  return items / a_leaf + (items % a_leaf != 0 ? 1u : 0u);
}
constexpr uint32_t nodes_for(uint32_t leaves) { return 2 * leaves - 1; }

/// A base hull as one block of bytes: head, then in this order, each beginning at a multiple of 4:
/// NodeBox of the tree over the faces, each within the head's box; uint32_t for every second leaf,
/// where its corners begin; BaseHullFace[face_count]; corners, the base hull's own uint16_t numbers
/// of its vertices, leaf by leaf; coordinates of the made vertices (3 x coordinate_bytes each);
/// BaseHullVertex[kept_count]. Up to here it is *resident*: all that a query reads. Links to the
/// hull follow: ids of the made vertices (id_bytes each); BaseHullTriangle[triangle_count].
struct BaseHullHead {
  uint32_t bytes;  // of the whole block
  uint32_t cut;    // the hull after so many collapses
  uint32_t face_count;
  uint32_t made_count;      // vertices made by a collapse, first
  uint32_t kept_count;      // vertices of the mesh, behind them
  uint32_t triangle_count;  // faces that are triangles of the mesh
  uint32_t corner_count;    // of all leaves
  float low_m[3], high_m[3];
};
static_assert(sizeof(BaseHullHead) == 52 && alignof(BaseHullHead) == 4);
/// Indices of its three corners among those of its leaf in bits 0 to 3, 4 to 7 and 8 to 11; the
/// count of these in bits 12 to 15.
using BaseHullFace = uint16_t;
constexpr uint32_t kMaxLeafCorners = 3 * kLeafFaces;
constexpr uint32_t corner_at(BaseHullFace face, uint32_t k) {
  return (uint32_t{face} >> (4 * k)) & 15u;
}
constexpr uint32_t corners_of(BaseHullFace face) { return uint32_t{face} >> 12; }
constexpr uint32_t corner_offsets_for(uint32_t leaves) { return (leaves + 1) / 2; }

struct BaseHullVertex {
  uint32_t id;
  float x_m, y_m, z_m;
};
static_assert(sizeof(BaseHullVertex) == 16);
/// In rising order of face.
struct BaseHullTriangle {
  uint32_t face, triangle;
};
static_assert(sizeof(BaseHullTriangle) == 8);
constexpr uint32_t kMaxBaseHullVertices = 65536;

constexpr uint32_t padded(uint32_t bytes) { return (bytes + 3) & ~3u; }

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The head is absent or not 64 bytes long.
  kRuleHeadSize = 501,
  // The vertex count (0) or triangle count (1) is not the mesh's; there are more collapses than
  // faces allow (2), or more ids or triangles than id_bytes can express or 2^24 (3).
  kRuleCounts = 502,
  // id_bytes (0) or coordinate_bytes (1) is neither 2 nor 3.
  kRuleWidths = 503,
  // The vertex section does not hold one vertex a collapse.
  kRuleVerticesSize = 504,
  // The origin section does not hold one number an id.
  kRuleOriginsSize = 505,
  // The record section is not record_bytes long.
  kRuleRecordsSize = 506,
  // The record offset section does not hold one offset for every eight collapses.
  kRuleRecordOffsetsSize = 507,
  // The star box section does not hold one box a collapse.
  kRuleStarBoxesSize = 508,
  // The box section does not hold the tree over the triangles.
  kRuleBoxesSize = 509,
  // The grid begins beyond 1e8 m (axis), or the cell is no power of two from 2^-95 to 1e8 m (3).
  kRuleGrid = 510,
  // The head's box is inverted or reaches beyond 1e8 m (0), or does not contain the mesh's box
  // (1).
  kRuleHeadBox = 511,
  // No mesh head has this name.
  kRuleMeshHead = 512,
  // The mesh's vertex section does not hold vertex_count vertices.
  kRuleMeshVerticesSize = 513,
  // The mesh's triangle section does not hold triangle_count triangles.
  kRuleMeshTrianglesSize = 514,
  // The box of the mesh's head is inverted or reaches beyond 1e8 m.
  kRuleMeshBox = 515,
  // A vertex of the mesh is NaN or lies outside its head's box.
  kRuleMeshVertex = 520,
  // The number of an id is beyond all vertices.
  kRuleOriginRange = 521,
  // Two ids have the same number (checked by a sum of hashes).
  kRuleOriginTwice = 523,
  // A record does not begin at its stored offset, or extends beyond the section.
  kRuleRecordOffset = 524,
  // A link has fewer than 3 corners or is not split in two.
  kRuleLink = 525,
  // A corner of the link is no id, is removed before or by this collapse, or is made by it or
  // later.
  kRuleLinkCorner = 526,
  // The new vertex is no id, is not this collapse's, or is removed before or by it.
  kRuleNewVertex = 527,
  // The triangles of the star are not, one by one, the mesh's.
  kRuleStarTriangles = 528,
  // The new vertex lies outside the head's box.
  kRuleNewVertexOutside = 529,
  // The star is not inside its box, as float32 computes it.
  kRuleStarBox = 530,
  // The records end before their section does.
  kRuleRecordsEnd = 531,
  // A triangle of the mesh has a corner that is no vertex of it.
  kRuleTriangleCorner = 532,
  // A triangle is not inside the box of its leaf, as float32 computes it, or a box above that
  // leaf is inverted.
  kRuleLeafBox = 533,
  // The faces do not balance: each triangle of the mesh and each face made must be replaced by one
  // collapse or belong to the coarsest hull (checked by a sum of hashes).
  kRuleFaces = 534,
  // The base hull is absent or not as long as it states (0), or not as long as its counts require
  // (1).
  kRuleBaseHullSize = 540,
  // The base hull follows more collapses than there are (0), has another face count than they
  // leave (1), more than 65,536 vertices (2), or more triangles than faces (3).
  kRuleBaseHullCounts = 541,
  // The base hull's box is inverted or outside the hull's.
  kRuleBaseHullBox = 542,
  // A vertex is no id, does not exist after that many collapses, or is among the wrong kind.
  kRuleBaseHullVertex = 543,
  // The coordinates of a vertex are not, to the bit, the hull's or the mesh's.
  kRuleBaseHullPosition = 544,
  // The corners of a leaf do not follow those of the previous leaf or are no vertices; a face
  // states another corner count or names a corner beyond it; or a corner belongs to no leaf.
  kRuleBaseHullCorners = 545,
  // The triangles are not, in rising order, those faces that are triangles of the mesh.
  kRuleBaseHullTriangles = 546,
  // A face is not inside the box of its leaf or of a node above it, as float32 computes it.
  kRuleBaseHullLeafBox = 547,
  // An edge of the base hull has no opposite (checked by a sum of hashes).
  kRuleBaseHullOpen = 548,
  // The base hull in the asset is not the coarsest hull.
  kRuleBaseHullCut = 549,
};

}  // namespace firmtouch::hull
