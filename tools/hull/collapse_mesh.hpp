#pragma once
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The star of an edge in order: its link counter-clockwise from outside, as a Collapse has it.
struct Star {
  uint32_t u = 0, v = 0;
  std::vector<uint32_t> link;
  uint32_t split = 0;

  uint32_t face_count() const { return static_cast<uint32_t>(link.size()) + 2; }
  /// Faces 0 to link.size() - 1 survive the collapse: face i has the edge i of the link. The last
  /// two are those of the edge, which vanish.
  Face face(uint32_t i) const;
};

/// A closed 2-manifold mesh while its edges collapse.
class CollapseMesh {
 public:
  explicit CollapseMesh(const Surface& surface);

  const std::vector<math::Vec3>& vertices() const { return vertices_; }
  uint32_t face_count() const { return face_count_; }
  uint32_t edge_count() const { return static_cast<uint32_t>(ends_.size()); }  // ever
  bool is_edge(uint32_t edge) const { return is_edge_[edge]; }
  const std::vector<uint32_t>& edges_of(uint32_t vertex) const { return edges_of_[vertex]; }
  /// Faces around both ends, the two of the edge counted twice.
  uint32_t crowd_of(uint32_t edge) const;

  /// Result: false where the mesh would not stay a manifold (link condition): the ends have a third
  /// neighbour in common, or a corner opposite the edge has only three faces.
  bool star_of(uint32_t edge, Star& star) const;

  /// Collapses the edge of `star` to a new vertex. Appends the edges that vanish to `gone`.
  void collapse(const Star& star, math::Vec3 to_m, std::vector<uint32_t>& gone);

 private:
  struct Ends {
    uint32_t a, b;
  };
  void chain(uint32_t around, uint32_t other, std::vector<uint32_t>& link) const;
  void take_over(uint32_t from, uint32_t other, uint32_t to);
  void take_over_edges(const Star& star, uint32_t to, std::vector<uint32_t>& gone);
  uint32_t other_end(uint32_t edge, uint32_t vertex) const {
    return ends_[edge].a == vertex ? ends_[edge].b : ends_[edge].a;
  }

  std::vector<math::Vec3> vertices_;
  std::vector<Face> faces_;
  std::vector<std::vector<uint32_t>> faces_of_, edges_of_;
  std::vector<Ends> ends_;
  std::vector<bool> is_edge_;
  uint32_t face_count_;
};

}  // namespace firmtouch::tools
