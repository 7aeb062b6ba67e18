#include "simd/wide_mesh.hpp"

namespace firmtouch::simd {

WideMesh::WideMesh(const mesh::View& mesh, const firmtouch_simd::Level& level) : view_(mesh) {
  if (level.searches == nullptr || mesh.head().triangle_count > kMaxWideTriangles) return;
  tree_.emplace(mesh);
  searches_ = level.searches;
}

// One object is returned in each, so it is built where the caller wants it: a copy by vectors would
// wait for the stores of its floats.
mesh::Closest WideMesh::closest_point(math::Vec3 p_m, query::Budget budget,
                                      mesh::Hint& hint) const {
  mesh::Closest closest;
  if (searches_ != nullptr)
    searches_->closest_point(&view_, &tree_->tree(), &p_m.x, &budget, &hint, &closest);
  else
    closest = mesh::closest_point(view_, p_m, budget, hint);
  return closest;
}

mesh::Hit WideMesh::cast_segment(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const {
  mesh::Hit hit;
  if (searches_ != nullptr)
    searches_->cast_segment(&view_, &tree_->tree(), &a_m.x, &b_m.x, &budget, &hit);
  else
    hit = mesh::cast_segment(view_, a_m, b_m, budget);
  return hit;
}

mesh::Hit WideMesh::any_crossing(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const {
  mesh::Hit hit;
  if (searches_ != nullptr)
    searches_->any_crossing(&view_, &tree_->tree(), &a_m.x, &b_m.x, &budget, &hit);
  else
    hit = mesh::any_crossing(view_, a_m, b_m, budget);
  return hit;
}

mesh::Crossings WideMesh::all_crossings(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                                        core::Span<mesh::SurfaceCrossing> buffer) const {
  mesh::Crossings crossings;
  if (searches_ != nullptr)
    searches_->all_crossings(&view_, &tree_->tree(), &a_m.x, &b_m.x, &budget, buffer.data(),
                             static_cast<uint32_t>(buffer.size()), &crossings);
  else
    crossings = mesh::all_crossings(view_, a_m, b_m, budget, buffer);
  return crossings;
}

}  // namespace firmtouch::simd
