#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/query/headed_view.hpp"
#include "firmtouch/query/seen_box.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::math {
struct Extents;
}

namespace firmtouch::mesh {

/// The bytes of a mesh's sections, as the container hands them out. One of triangles16 and
/// triangles32; the normals and folds are empty for an unsigned mesh, leaf_boxes except for a
/// bounded bake, box_frame except for boxes turned against the axes.
struct Sections {
  core::Bytes head, vertices, triangles16, triangles32, nodes, parents, vertex_normals, edge_folds,
      leaf_boxes, box_frame;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kHeadSection, head), take(kVerticesSection, vertices),
        take(kTriangles16Section, triangles16), take(kTriangles32Section, triangles32),
        take(kNodesSection, nodes), take(kParentsSection, parents),
        take(kVertexNormalsSection, vertex_normals), take(kEdgeFoldsSection, edge_folds),
        take(kLeafBoxesSection, leaf_boxes), take(kBoxFrameSection, box_frame);
  }
};

/// A mesh that open() has proven: every index, box, depth and float. Immutable; share it between
/// any number of tools.
class View : public query::HeadedView<Head, Sections> {
 public:
  bool is_signed() const { return !folds_.empty(); }
  core::Span<const Vertex> vertices() const { return vertices_; }
  core::Span<const Node> nodes() const { return nodes_; }
  /// Both sides of each node, in the order of their places.
  const Side* sides() const { return nodes_.data()->side; }
  core::Span<const uint32_t> parents() const { return parents_; }
  core::Span<const uint32_t> vertex_normals() const { return vertex_normals_; }
  core::Span<const EdgeFolds> folds() const { return folds_; }
  /// Null where the asset has none: what they hold follows from the rest.
  const uint32_t* leaf_boxes() const { return leaf_boxes_; }
  /// Null where the boxes lie along the axes.
  const BoxFrame* box_frame() const { return box_frame_; }
  /// Whether float32 alone cannot keep the promise of exact answers (mesh/loss.hpp): the search
  /// keeps the rivals of the nearest triangle, which are then measured in double-float.
  bool has_rivals() const { return has_rivals_; }
  core::Span<const Triangle<uint16_t>> triangles16() const { return triangles16_; }
  core::Span<const Triangle<uint32_t>> triangles32() const { return triangles32_; }

  /// Corners of a triangle, in the order of the edge folds.
  Triangle<uint32_t> triangle(uint32_t i) const {
    if (!triangles16_.empty()) {
      const Triangle<uint16_t>& t = triangles16_[i];
      return {{t.corner[0], t.corner[1], t.corner[2]}};
    }
    return triangles32_[i];
  }
  math::Vec3 vertex(uint32_t i) const {
    return {vertices_[i].x_m, vertices_[i].y_m, vertices_[i].z_m};
  }

 private:
  friend class Proof;
  core::Span<const Vertex> vertices_;
  core::Span<const Triangle<uint16_t>> triangles16_;
  core::Span<const Triangle<uint32_t>> triangles32_;
  core::Span<const Node> nodes_;
  core::Span<const uint32_t> parents_;
  core::Span<const uint32_t> vertex_normals_;
  core::Span<const EdgeFolds> folds_;
  const uint32_t* leaf_boxes_ = nullptr;
  const BoxFrame* box_frame_ = nullptr;
  bool has_rivals_ = false;
};

/// What Opening proves of a mesh: rules R101 to R139 of tools/FORMAT.md.
class Proof {
 public:
  static const query::CheckStage kStages[4];
  core::Verdict take(const Sections& sections);
  core::Verdict check_head();
  View view;

 private:
  core::Verdict take_leaf_boxes(const Sections& sections);
  core::Verdict check_grid(float reach_m, float extent_m) const;
  uint32_t vertex_count() const { return view.vertices_.size(); }
  // Whose triangles take half the instructions of others: without boxes of leaves and turned boxes.
  uint32_t plain_node_count() const {
    return view.leaf_boxes_ == nullptr && view.box_frame_ == nullptr ? view.nodes_.size() : 0;
  }
  uint32_t other_node_count() const { return view.nodes_.size() - plain_node_count(); }
  core::Verdict check_vertices(uint32_t first, uint32_t end);
  core::Verdict finish_vertices();
  uint32_t fold_words() const { return view.folds_.size() * 3 / 4; }
  core::Verdict check_folds(uint32_t first, uint32_t end);
  core::Verdict finish_folds();
  core::Verdict finish_nodes();
  uint16_t broken_rule(uint32_t triangle, math::Extents& seen) const;
  core::Verdict check_nodes(uint32_t first, uint32_t end);
  bool is_along(uint32_t k, uint32_t axis, float low_m, float high_m) const;
  core::Verdict check_leaf(uint32_t node, uint32_t which);
  core::Verdict check_leaf_box(uint32_t first, uint32_t count) const;

  // Leaves hold the triangles in the order of their nodes: none twice, none left out.
  uint32_t next_triangle_ = 0;
  uint32_t deepest_ = 0;
  uint32_t children_ = 0;
  query::SeenBox seen_;
};

using Opening = query::Opening<Proof>;

/// All at once.
inline core::Verdict open(const Sections& sections, View& view) {
  return query::open_at_once<Opening>(view, sections);
}

}  // namespace firmtouch::mesh

extern template class firmtouch::query::Opening<firmtouch::mesh::Proof>;
