#pragma once
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/mesh/view.hpp"
#include "hull/progressive_hull.hpp"

namespace firmtouch::tools {

/// Writes a progressive hull of `mesh` (same numbers of vertices and triangles) as sections.
class HullEncoder {
 public:
  HullEncoder(const ProgressiveHull& hull, const mesh::View& mesh);

  /// Why it does not fit, or empty.
  std::string problem() const;
  std::vector<Section> run(const std::string& name);

 private:
  void make_head();
  void assign_ids();
  void put_vertices();
  void put_records();
  hull::StarBox star_box(uint32_t collapse) const;
  std::vector<hull::NodeBox> triangle_boxes() const;
  std::vector<uint8_t> coarsest() const;
  void put_id(std::vector<uint8_t>& bytes, uint32_t value) const;
  uint32_t triangle_of(const Face& numbers) const;
  std::vector<Face> star_faces(uint32_t collapse) const;

  const ProgressiveHull& hull_;
  const mesh::View& mesh_;
  hull::Head head_{};
  std::vector<uint32_t> id_, numbers_;                 // of a number; of an id
  std::vector<std::pair<Face, uint32_t>> by_corners_;  // the mesh's triangles, sorted
  std::vector<uint8_t> vertices_, origins_, records_;
  std::vector<uint32_t> places_;
  std::vector<hull::StarBox> star_boxes_;
};

}  // namespace firmtouch::tools
