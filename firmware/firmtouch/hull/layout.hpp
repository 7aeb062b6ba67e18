#pragma once
#include <stddef.h>
#include <stdint.h>

// How a progressive hull lies in an asset, byte for byte (tools/FORMAT.md says it in words). It
// shares the name of its mesh, whose triangles are its finest faces.

namespace firmtouch::hull {

constexpr uint32_t kHeadSection = 0x5001;
constexpr uint32_t kVerticesSection = 0x5002;   // of collapse k: its new vertex, on the grid
constexpr uint32_t kOriginsSection = 0x5003;    // of each id: the number of its vertex
constexpr uint32_t kRecordsSection = 0x5004;    // of collapse k: its star
constexpr uint32_t kPlacesSection = 0x5005;     // uint32_t: where every eighth record begins
constexpr uint32_t kStarBoxesSection = 0x5006;  // StarBox[collapse_count]
constexpr uint32_t kBoxesSection = 0x5007;      // NodeBox: a tree over the mesh's triangles
constexpr uint32_t kBaseHullSection = 0x5008;   // the coarsest hull (hull/shell.hpp)
constexpr uint32_t kProbesSection = 0x5009;     // query::ProbeHead and its points

// Numbers: 0 to mesh_vertex_count - 1 are the mesh's vertices, mesh_vertex_count + k is the new one
// of collapse k. Ids: the two vertices that collapse k removes have the ids 2 k and 2 k + 1, those
// that stay to the end the others. So an id tells what removes its vertex, with no table.
constexpr uint32_t removed_by(uint32_t id) { return id >> 1; }

// Three bytes an id, at most.
constexpr uint32_t kMaxIds = 1u << 24;
constexpr uint32_t kRecordsAPlace = 8;
// A star keeps its corners in an array.
constexpr uint32_t kMaxLink = 31;
constexpr uint32_t kMaxStarFaces = kMaxLink + 2;

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
//   head: faces of the link in bits 0 to 4, of them opposite vertex 2 k in bits 5 to 9, triangles of
//   the mesh in bits 10 to 15.
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

/// A box about a star, as it lies from the new vertex: 6 reaches of 7 bits (below and above on x, y,
/// z) in units of the grid's cell times two to the power of the last 6 bits.
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

// A leaf of the tree over the mesh holds so many triangles, of the tree over a shell so many faces.
constexpr uint32_t kLeafTriangles = 4;
constexpr uint32_t kLeafFaces = 4;
constexpr uint32_t kMaxTreeDepth = 24;

constexpr uint32_t leaves_for(uint32_t items, uint32_t a_leaf) {
  return items / a_leaf + (items % a_leaf != 0 ? 1u : 0u);
}
constexpr uint32_t nodes_for(uint32_t leaves) { return 2 * leaves - 1; }

/// A hull as a block of bytes that needs no neighbours to be tested: head, then in this order, each
/// beginning at a multiple of 4: NodeBox of the tree over the faces, each within the head's box;
/// uint32_t for every second leaf, where its corners begin; BaseHullFace[face_count]; corners, the
/// shell's own uint16_t numbers of its vertices, leaf by leaf; coordinates of the made vertices (3 x
/// coordinate_bytes each); BaseHullVertex[kept_count]. Up to here it is *resident*, what a test of the
/// shell reads; what ties it to the hull comes behind: ids of the made vertices (id_bytes each);
/// BaseHullTriangle[triangle_count].
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
/// Places of its three corners among those of its leaf in bits 0 to 3, 4 to 7, 8 to 11; in bits 12 to
/// 15 how many those are.
using BaseHullFace = uint16_t;
constexpr uint32_t kMaxLeafCorners = 3 * kLeafFaces;
constexpr uint32_t corner_at(BaseHullFace face, uint32_t k) {
  return (uint32_t{face} >> (4 * k)) & 15u;
}
constexpr uint32_t corners_of(BaseHullFace face) { return uint32_t{face} >> 12; }
constexpr uint32_t corner_places_for(uint32_t leaves) { return (leaves + 1) / 2; }

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

}  // namespace firmtouch::hull
