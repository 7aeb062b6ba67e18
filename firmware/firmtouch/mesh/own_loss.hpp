#pragma once
// What float32 can have lost of the nearest triangles of a search, by their own edges. For the
// library's own translation units.

#include "firmtouch/mesh/nearest_search.hpp"

namespace firmtouch::mesh {
namespace {

struct Corners {
  Triangle<uint32_t> index;
  Vec3 a_m, b_m, c_m;

  // Inlined: GCC 12 drops the stores of a constructor that a cold function calls.
  [[gnu::always_inline]] inline Corners(const View& mesh, uint32_t triangle)
      : index(mesh.triangle(triangle)),
        a_m(mesh.vertex(index.corner[0])),
        b_m(mesh.vertex(index.corner[1])),
        c_m(mesh.vertex(index.corner[2])) {}
  [[gnu::always_inline]] inline float ab2_m2() const { return math::dot(b_m - a_m, b_m - a_m); }
  [[gnu::always_inline]] inline float compensated_m(Vec3 p_m, Feature feature,
                                                    float distance2_m2) const {
    return math::square_root(nearest_compensated2(p_m, a_m, b_m, c_m, feature, distance2_m2));
  }
};

// What float32 and the rounding of the model can have lost of a triangle, by its own edges.
inline float own_loss_m(const Loss& loss, const Corners& corners, Feature feature,
                        float distance_m) {
  const float ab2_m2 = corners.ab2_m2();
  return Loss::own_m(distance_m, ab2_m2, math::square_root(ab2_m2), feature == Feature::kFace) +
         loss.rounding_m;
}
// The same of the nearest, whose foot is known.
inline float best_loss_m(const Loss& loss, const Corners& corners, Vec3 p_m, const Best& best,
                         float distance_m) {
  const Vec3& from_m = best.feature == Feature::kEdge1 ? corners.b_m : corners.a_m;
  const float reach_m = math::length((p_m - from_m) - best.offset_m);
  return Loss::own_m(distance_m, corners.ab2_m2(), reach_m, best.feature == Feature::kFace) +
         loss.rounding_m;
}

// The least distance that each of the rivals may truly have.
inline float rivals_lower_m(const View& mesh, const Loss& loss, const Search& search) {
  float lower_m = search.rivals.rest_m;
  for (uint32_t i = 0; i < search.rivals.count; ++i) {
    const float rival_m = math::square_root(search.rivals.distance2_m2[i]);
    const Corners corners(mesh, search.rivals.triangle(i));
    lower_m = math::smaller(lower_m,
                            rival_m - own_loss_m(loss, corners, search.rivals.feature(i), rival_m));
  }
  return lower_m;
}

}  // namespace
}  // namespace firmtouch::mesh
