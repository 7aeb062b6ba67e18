#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/query/headed_view.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::hull {

struct HashedNumber;

/// The bytes of a hull's sections and of those of its mesh that a hull reads (not the mesh's tree).
/// One of triangles16 and triangles32 is empty.
struct Sections {
  core::Bytes head, vertices, origins, records, record_offsets, star_boxes, boxes, base_hull;
  core::Bytes mesh_head, mesh_vertices, triangles16, triangles32;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kHeadSection, head), take(kVerticesSection, vertices), take(kOriginsSection, origins),
        take(kRecordsSection, records), take(kRecordOffsetsSection, record_offsets),
        take(kStarBoxesSection, star_boxes), take(kBoxesSection, boxes),
        take(kBaseHullSection, base_hull), take(mesh::kHeadSection, mesh_head),
        take(mesh::kVerticesSection, mesh_vertices), take(mesh::kTriangles16Section, triangles16),
        take(mesh::kTriangles32Section, triangles32);
  }
};

/// A progressive hull that open() has proven. Immutable; share it between any number of tools.
class View : public query::HeadedView<Head, Sections> {
 public:
  const mesh::Head& mesh_head() const { return *mesh_head_; }
  uint32_t collapse_count() const { return head_->collapse_count; }
  uint32_t id_count() const { return head_->mesh_vertex_count + head_->collapse_count; }
  /// The coarsest hull.
  const BaseHull& base_hull() const { return base_hull_; }

  /// Of an id: a vertex of the mesh, or mesh_vertex_count + the collapse that makes it.
  uint32_t number_of(uint32_t id) const { return read_id(&origins_[id * head_->id_bytes]); }
  mesh::Triangle<uint32_t> triangle(uint32_t i) const {
    if (!triangles16_.empty()) {
      const mesh::Triangle<uint16_t>& t = triangles16_[i];
      return {{t.corner[0], t.corner[1], t.corner[2]}};
    }
    return triangles32_[i];
  }
  math::Vec3 mesh_vertex(uint32_t i) const {
    return {mesh_vertices_[i].x_m, mesh_vertices_[i].y_m, mesh_vertices_[i].z_m};
  }
  /// The record of a collapse, at its head.
  const uint8_t* record(uint32_t collapse) const {
    const uint8_t* at = records_.data() + record_offsets_[collapse / kRecordsPerOffset];
    for (uint32_t skip = collapse % kRecordsPerOffset; skip > 0; --skip)
      at += record_size(head_of(at), head_->id_bytes);
    return at;
  }
  static uint32_t head_of(const uint8_t* record) {
    return record[0] | static_cast<uint32_t>(record[1]) << 8;
  }
  /// Of a record: 0 the new vertex, 1 and on the link, then the mesh's triangles.
  uint32_t id_in(const uint8_t* record, uint32_t i) const {
    return read_id(record + 2 + i * head_->id_bytes);
  }
  const uint8_t* coordinates(uint32_t collapse) const {
    return &vertices_[collapse * 3 * head_->coordinate_bytes];
  }
  const StarBox& star_box(uint32_t collapse) const { return star_boxes_[collapse]; }
  core::Span<const NodeBox> boxes() const { return boxes_; }

 private:
  friend class Proof;
  uint32_t read_id(const uint8_t* at) const {
    const uint32_t low = at[0] | static_cast<uint32_t>(at[1]) << 8;
    return head_->id_bytes == 2 ? low : low | static_cast<uint32_t>(at[2]) << 16;
  }

  const mesh::Head* mesh_head_ = nullptr;
  core::Bytes vertices_, origins_, records_;
  core::Span<const uint32_t> record_offsets_;
  core::Span<const StarBox> star_boxes_;
  core::Span<const NodeBox> boxes_;
  core::Span<const mesh::Vertex> mesh_vertices_;
  core::Span<const mesh::Triangle<uint16_t>> triangles16_;
  core::Span<const mesh::Triangle<uint32_t>> triangles32_;
  BaseHull base_hull_;
};

/// What Opening proves of a hull: rules R501 to R549 of tools/FORMAT.md. It needs the mesh's
/// vertices and triangles, not the mesh's proof.
class Proof {
 public:
  static const query::CheckStage kStages[6];
  core::Verdict take(const Sections& sections);
  core::Verdict check_head() const;
  View view;

 private:
  core::Verdict take_mesh(const Sections& sections);
  uint32_t vertex_count() const { return view.mesh_head().vertex_count; }
  uint32_t id_count() const { return view.id_count(); }
  uint32_t record_count() const { return view.collapse_count(); }
  uint32_t leaf_count() const;
  uint32_t base_vertex_count() const { return base_hull_.vertex_count(); }
  uint32_t base_face_count() const { return base_hull_.face_count(); }
  core::Verdict check_mesh_vertices(uint32_t first, uint32_t end);
  core::Verdict check_ids(uint32_t first, uint32_t end);
  core::Verdict finish_ids();
  core::Verdict finish_records();
  core::Verdict check_record(uint32_t collapse);
  core::Verdict check_star(uint32_t collapse, const uint8_t* record);
  core::Verdict check_faces(uint32_t collapse, const uint8_t* record, const HashedNumber* corners);
  core::Verdict check_leaves(uint32_t first, uint32_t end);
  core::Verdict finish_leaves();
  core::Verdict check_base_vertex(uint32_t i);
  core::Verdict check_base_face(uint32_t i);
  core::Verdict finish_base_hull();

  core::Bytes base_hull_bytes_;
  uint32_t record_at_ = 0;
  // Sums of hashes, which compare two multisets without memory: each number has one id; each face
  // of the mesh or made is replaced once or left.
  uint64_t numbers_ = 0, faces_ = 0;
  BaseHullProof base_hull_;
};

using Opening = query::Opening<Proof>;

/// All at once.
inline core::Verdict open(const Sections& sections, View& view) {
  return query::open_at_once<Opening>(view, sections);
}

}  // namespace firmtouch::hull

extern template class firmtouch::query::Opening<firmtouch::hull::Proof>;
