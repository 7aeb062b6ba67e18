#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/query/staged_check.hpp"

namespace firmtouch::mesh {

/// The bytes of a mesh's sections, as the container hands them out. One of triangles16 and
/// triangles32; the normals and folds are empty for an unsigned mesh, leaf_boxes and shapes except
/// for a bounded bake.
struct Sections {
  core::Bytes head, vertices, triangles16, triangles32, nodes, parents, vertex_normals, edge_folds,
      leaf_boxes, shapes;
};

/// A mesh that open() has proven: every index, box, depth and float. Immutable; share it between
/// any number of tools.
class View {
 public:
  View() = default;

  bool is_open() const { return head_ != nullptr; }
  bool is_signed() const { return !folds_.empty(); }
  const Head& head() const { return *head_; }
  core::Span<const Vertex> vertices() const { return vertices_; }
  core::Span<const Node> nodes() const { return nodes_; }
  /// Both sides of each node, in the order of their places.
  const Side* sides() const { return nodes_.data()->side; }
  core::Span<const uint32_t> parents() const { return parents_; }
  core::Span<const uint32_t> vertex_normals() const { return vertex_normals_; }
  core::Span<const EdgeFolds> folds() const { return folds_; }
  /// Null where the asset has none: what they hold follows from the rest.
  const uint32_t* leaf_boxes() const { return leaf_boxes_; }
  const TriangleShape* shapes() const { return shapes_; }
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
  friend class Opening;
  const Head* head_ = nullptr;
  core::Span<const Vertex> vertices_;
  core::Span<const Triangle<uint16_t>> triangles16_;
  core::Span<const Triangle<uint32_t>> triangles32_;
  core::Span<const Node> nodes_;
  core::Span<const uint32_t> parents_;
  core::Span<const uint32_t> vertex_normals_;
  core::Span<const EdgeFolds> folds_;
  const uint32_t* leaf_boxes_ = nullptr;
  const TriangleShape* shapes_ = nullptr;
};

/// Proves a mesh in slices, so that a main loop stays alive while it opens a large one: rules R101
/// to R141 of tools/FORMAT.md.
///
///     Opening opening(sections);
///     while (!opening.done()) opening.work(1000);
///     if (opening.verdict().ok()) view = opening.view();
class Opening {
 public:
  explicit Opening(const Sections& sections);

  /// Checks up to `elements` vertices, nodes or triangles more.
  /// Bounds: O(elements); no recursion; reads only inside the sections.
  void work(uint32_t elements);
  bool done() const { return check_.done(); }
  core::Verdict verdict() const { return check_.verdict(); }
  /// The proven mesh; one that is not open unless done() and verdict().ok().
  View view() const { return check_.has_passed() ? view_ : View{}; }

 private:
  static const query::CheckStage<Opening> kStages[4];
  core::Verdict open_head(const Sections& sections);
  core::Verdict open_bounded(const Sections& sections);
  uint32_t vertex_count() const { return view_.vertices_.size(); }
  uint32_t normal_count() const { return view_.vertex_normals_.size(); }
  uint32_t node_count() const { return view_.nodes_.size(); }
  uint32_t triangle_count() const { return view_.head_->triangle_count; }
  core::Verdict check_vertex(uint32_t i);
  core::Verdict finish_vertices();
  core::Verdict check_normal(uint32_t i);
  core::Verdict check_node(uint32_t i);
  core::Verdict finish_nodes();
  core::Verdict check_leaf(uint32_t node, uint32_t which);
  core::Verdict check_leaf_box(uint32_t first, uint32_t count) const;
  TriangleShape shape_at(uint32_t triangle) const;
  core::Verdict check_shape(uint32_t i) const;
  core::Verdict check_triangle(uint32_t i);

  View view_;
  query::StagedCheck check_;
  // Leaves hold the triangles in the order of their nodes: none twice, none left out.
  uint32_t next_triangle_ = 0;
  uint32_t deepest_ = 0;
  query::SeenBox seen_;
};

/// All at once.
core::Verdict open(const Sections& sections, View& view);

}  // namespace firmtouch::mesh
