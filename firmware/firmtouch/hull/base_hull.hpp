#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/hull/layout.hpp"

namespace firmtouch::hull {

class View;

/// One level of a progressive hull, as a proven block of bytes. The asset holds the coarsest; tools
/// cut finer ones. A query reads only the block's resident part, which may be copied to fast
/// memory.
class BaseHull {
 public:
  BaseHull() = default;

  bool is_open() const { return head_ != nullptr; }
  const BaseHullHead& head() const { return *head_; }
  uint32_t face_count() const { return head_->face_count; }
  core::Span<const NodeBox> boxes() const { return boxes_; }
  /// A leaf: its faces, and the vertices at their corners, each once.
  struct Leaf {
    uint32_t first_face;
    core::Span<const BaseHullFace> faces;
    core::Span<const uint16_t> corners;
  };
  Leaf leaf(uint32_t i) const {
    const uint32_t first = i * kLeafFaces, left = head_->face_count - first;
    const uint32_t before = i % 2 == 0 ? 0 : corners_of(faces_[first - kLeafFaces]);
    return {first,
            {&faces_[first], left < kLeafFaces ? left : kLeafFaces},
            {&corners_[corner_offsets_[i / 2] + before], corners_of(faces_[first])}};
  }
  /// The base hull's own number of a face's corner.
  uint32_t vertex_of(uint32_t face, uint32_t k) const {
    return leaf(face / kLeafFaces).corners[corner_at(faces_[face], k)];
  }
  bool is_made(uint32_t vertex) const { return vertex < head_->made_count; }
  const uint8_t* coordinates(uint32_t made) const {
    return &coordinates_[made * 3 * coordinate_bytes_];
  }
  /// The upper two bytes of each coordinate.
  const uint8_t* upper_coordinates() const { return coordinates_.data() + coordinate_bytes_ - 2; }
  uint32_t coordinate_bytes() const { return coordinate_bytes_; }
  const BaseHullVertex& kept(uint32_t vertex) const { return kept_[vertex - head_->made_count]; }
  uint32_t id_of(uint32_t vertex) const {
    if (!is_made(vertex)) return kept(vertex).id;
    const uint8_t* at = &ids_[vertex * id_bytes_];
    const uint32_t low = at[0] | static_cast<uint32_t>(at[1]) << 8;
    return id_bytes_ == 2 ? low : low | static_cast<uint32_t>(at[2]) << 16;
  }
  core::Span<const BaseHullTriangle> triangles() const { return triangles_; }
  /// Length of the resident part: the block's first bytes, all that a query reads.
  uint32_t resident_bytes() const;
  /// The same base hull with its resident part in `copy`: the first resident_bytes() of the block.
  /// Result: not open if `copy` differs, or is not at a multiple of 4.
  BaseHull resident(core::Bytes copy) const;

  // Of the grid, kept here so that a test reads nothing else.
  const float* grid_low_m() const { return grid_low_m_; }
  float cell_m() const { return cell_m_; }

 private:
  friend class BaseHullProof;
  bool point_into(core::Bytes resident, uint32_t coordinate_bytes);
  const BaseHullHead* head_ = nullptr;
  core::Span<const NodeBox> boxes_;
  core::Span<const uint32_t> corner_offsets_;
  core::Span<const BaseHullFace> faces_;
  core::Span<const uint16_t> corners_;
  core::Bytes coordinates_, ids_;
  core::Span<const BaseHullVertex> kept_;
  core::Span<const BaseHullTriangle> triangles_;
  uint32_t coordinate_bytes_ = 0, id_bytes_ = 0;
  float grid_low_m_[3] = {}, cell_m_ = 0;
};

/// Proves a base hull against its hull (whose ids and vertices must be proven), element by element:
/// rules R540 to R548. begin(), check_head(), every vertex, every face in rising order, finish().
class BaseHullProof {
 public:
  /// The sizes of its parts.
  core::Verdict begin(core::Bytes bytes, const View& hull);
  core::Verdict check_head(const View& hull) const;
  uint32_t vertex_count() const;
  uint32_t face_count() const { return base_hull_.head_->face_count; }
  core::Verdict check_vertex(uint32_t i, const View& hull) const;
  core::Verdict check_face(uint32_t i, const View& hull);
  core::Verdict finish() const;
  /// Pre: begin() has passed. It is proven when all has.
  const BaseHull& base_hull() const { return base_hull_; }
  /// Sum of the hashes of its faces (hull/face_hash.hpp).
  uint64_t faces() const { return faces_; }

 private:
  core::Verdict check_leaf(uint32_t leaf);
  core::Verdict check_box(uint32_t face) const;

  BaseHull base_hull_;
  uint32_t next_triangle_ = 0, next_corner_ = 0;
  uint64_t faces_ = 0, edges_ = 0;
};

/// All at once.
core::Verdict open_base_hull(core::Bytes bytes, const View& hull, BaseHull& base_hull);

}  // namespace firmtouch::hull
