#include "simd/wide_mesh.hpp"

namespace firmtouch::simd {
namespace {

// What `search` writes last. It is built where the caller wants it: a copy by vectors would wait
// for the stores of its floats.
template <class Answer, class Search, class... Words>
Answer answer_of(Search search, Words... words) {
  Answer answer;
  search(words..., &answer);
  return answer;
}

}  // namespace

WideMesh::WideMesh(const mesh::View& mesh, const firmtouch_simd::Level& level) : view_(mesh) {
  if (level.searches == nullptr || mesh.head().triangle_count > kMaxWideTriangles) return;
  tree_.emplace(mesh);
  searches_ = level.searches;
}

mesh::Closest WideMesh::closest_point(math::Vec3 p_m, query::Budget budget,
                                      mesh::Hint& hint) const {
  if (searches_ == nullptr) return mesh::closest_point(view_, p_m, budget, hint);
  return answer_of<mesh::Closest>(searches_->closest_point, &view_, &tree_->tree(), &p_m.x, &budget,
                                  &hint);
}

mesh::Hit WideMesh::cast_segment(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const {
  if (searches_ == nullptr) return mesh::cast_segment(view_, a_m, b_m, budget);
  return answer_of<mesh::Hit>(searches_->cast_segment, &view_, &tree_->tree(), &a_m.x, &b_m.x,
                              &budget);
}

mesh::Hit WideMesh::any_crossing(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget) const {
  if (searches_ == nullptr) return mesh::any_crossing(view_, a_m, b_m, budget);
  return answer_of<mesh::Hit>(searches_->any_crossing, &view_, &tree_->tree(), &a_m.x, &b_m.x,
                              &budget);
}

mesh::Crossings WideMesh::all_crossings(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                                        core::Span<mesh::SurfaceCrossing> buffer) const {
  if (searches_ == nullptr) return mesh::all_crossings(view_, a_m, b_m, budget, buffer);
  return answer_of<mesh::Crossings>(searches_->all_crossings, &view_, &tree_->tree(), &a_m.x,
                                    &b_m.x, &budget, buffer.data(),
                                    static_cast<uint32_t>(buffer.size()));
}

}  // namespace firmtouch::simd
