#pragma once
#include <cstdint>
#include <vector>

#include "hull/progressive_hull.hpp"

namespace firmtouch::tools {

struct Segment {
  Point from_m, to_m;
};

struct RefinementCounts {
  uint64_t tests = 0;   // of a face
  uint64_t splits = 0;  // of a vertex
};

struct SegmentHit {
  double t;       // 0 at from_m, 1 at to_m
  uint32_t face;  // of the mesh
};

/// The paper's selective refinement: a base hull is split where a segment hits it until only faces
/// of the mesh are hit, without a mesh that changes: the state is which vertices are split.
///
/// A face was made by the collapse of its youngest vertex and is replaced by the first collapse
/// that removes a vertex of it. It is there if that vertex is not split in the one case, and is
/// split (or after the base) in the other. To split a vertex, it and its link must be
/// there: the vertices that replaced these are split as well (the closure).
///
/// Result: for segments that begin and end outside the base hull, first and last hit are those of
///         the
///         mesh; hits between them may be missed where the segment passes below the hull.
/// Source: Platis & Theoharis 2003, section 3.2.
class Refinement {
 public:
  /// Any base: a cut of the same sequence.
  Refinement(const ProgressiveHull& hull, uint32_t base_faces);

  uint32_t base_face_count() const { return static_cast<uint32_t>(base_.faces.size()); }
  /// All hits found, by t, then face. Afterwards the state is that of the base again, or is kept
  /// for as many queries as keep_for() says.
  std::vector<SegmentHit> hits(const Segment& segment, RefinementCounts& counts);
  /// A split vertex stays split for this many queries; default 1.
  void keep_for(uint32_t queries) { keep_ = queries; }
  /// Selective coarsening (section 3.2.2): a vertex stays split unless the last query did not cross
  /// its star and no other split needs it.
  void coarsen_between(bool is_wanted) { coarsens_ = is_wanted; }
  /// The faces that are there when every vertex is split, in no order.
  std::vector<Face> all_split();
  /// Whether the segment touches the base hull's box.
  bool touches_box(const Segment& segment) const;

 private:
  void request_split(uint32_t collapse);
  void request_corners(const Face& face);
  void collapse_all();
  void coarsen();
  Face star_face(const Collapse& collapse, uint32_t i) const;
  bool is_of_mesh(const Face& face) const;
  bool is_made(const Face& face) const;  // the vertex that made it is not split
  bool crosses(const Face& face, const Segment& segment, double& t) const;
  uint32_t mesh_face(const Face& face) const;

  const ProgressiveHull& hull_;
  Surface base_;
  uint32_t cut_;  // collapses of the base
  uint32_t keep_ = 1, kept_ = 0;
  Point low_m_, high_m_;
  bool coarsens_ = false;
  std::vector<bool> is_split_;
  std::vector<bool> is_crossed_;                       // the star of a split vertex, by this query
  std::vector<uint32_t> split_;                        // in the order of the requests
  std::vector<std::pair<Face, uint32_t>> by_corners_;  // the mesh's faces, sorted
};

}  // namespace firmtouch::tools
