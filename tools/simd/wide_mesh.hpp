#pragma once
#include <optional>

#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "simd/build_tree.hpp"
#include "simd/levels.hpp"

namespace firmtouch::simd {

/// A mesh with the wide search of this processor: the answers, visits and hints of
/// mesh::closest_point() and of mesh/segment_cast.hpp, to the bit, in less time. The mesh's
/// sections must outlive it.
class WideMesh {
 public:
  WideMesh() = default;
  /// Pre: the mesh is open. Cost: O(triangles), unless the level is scalar.
  explicit WideMesh(const mesh::View& mesh,
                    const firmtouch_simd::Level& level = firmtouch_simd::level());

  const mesh::View& view() const { return view_; }

  mesh::Closest closest_point(math::Vec3 p_m, query::Budget budget, mesh::Hint& hint) const;
  mesh::Hit cast_segment(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const;
  mesh::Hit any_crossing(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const;
  mesh::Crossings all_crossings(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                                core::Span<mesh::SurfaceCrossing> buffer) const;

 private:
  mesh::View view_;
  std::optional<OwnedTree> tree_;
  const firmtouch_simd::Searches* searches_ = nullptr;  // null: the scalar search
};

}  // namespace firmtouch::simd
