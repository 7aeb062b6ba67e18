#include "firmtouch/scene/mesh_touched.hpp"

#include <float.h>

#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/swept_sphere.hpp"
#include "firmtouch/scene/pose_loss.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

constexpr uint32_t kBaseHullWork = 1280;  // as of penalty contact
// That an exact answer of a base hull is below the truth, in diagonals, and the clearance.
constexpr float kBaseHullLoss = 4e-6f;

template <class Pose>
void use_triangle(const MeshWithPose<Pose>& object, uint32_t triangle, Feature& feature) {
  const mesh::Triangle<uint32_t> corners = object.mesh->triangle(triangle);
  for (uint32_t k = 0; k < 3; ++k)
    feature.corner[k] = math::apply(object.pose, object.mesh->vertex(corners.corner[k]));
  feature.kind = Feature::Kind::kTriangle;
}

// The base hull's answer where the mesh's is not enough: the mesh is behind it.
template <class Pose>
void use_base_hull(const MeshWithPose<Pose>& object, Vec3 p_m, query::Budget budget, float needed_m,
                   float loss_m, Near& near) {
  if (near.is_exact || near.lower_m >= needed_m) return;
  if (object.base_hull == nullptr || !object.base_hull->is_open()) return;
  const query::Budget own{budget.work > kBaseHullWork ? budget.work : kBaseHullWork};
  const hull::BaseHullDistance found = hull::base_hull_distance(*object.base_hull, p_m, own);
  near.steps += found.steps;
  near.work += found.work;
  if (found.side != hull::BaseHullSide::kOutside) return;
  near.is_of_base_hull = true;
  near.sign = 1;
  const float lower_m = found.lower_m - loss_m;
  if (lower_m > near.lower_m) near.lower_m = lower_m;
  if (!found.exact) return;
  near.feature = {};
  near.feature.kind = Feature::Kind::kBall;
  near.feature.is_of_base_hull = true;
  near.feature.corner[0] = math::apply(object.pose, found.point_m);
  // A point that is so much thicker keeps the proxy where the hull's bound certifies it.
  near.feature.corner[1].x = kBaseHullLoss * object.mesh->head().diagonal_m;
  near.distance_m = found.lower_m;
}

}  // namespace

template <class Pose>
float free_part_of(const MeshWithPose<Pose>& object, Way& way, query::Budget budget,
                   uint32_t& work) {
  way.radius_m += pose_loss_m(object.pose, way.from_m);
  way.from_m = math::apply_inverse(object.pose, way.from_m);
  way.along_m = math::turn_back(object.pose, way.along_m);
  for (uint32_t k = 0; k < way.axes; ++k) way.axis[k] = math::turn_back(object.pose, way.axis[k]);
  const mesh::Sweep swept = mesh::sweep(*object.mesh, way, budget);
  work += swept.work;
  return swept.free_part;
}
template float free_part_of(const MeshObject&, Way&, query::Budget, uint32_t&);
template float free_part_of(const PlacedMesh&, Way&, query::Budget, uint32_t&);

template <bool kHasField, bool kHasBaseHull, class Object>
float MeshTouchedWith<kHasField, kHasBaseHull, Object>::size_m() const {
  return object.mesh->head().diagonal_m;
}

template <bool kHasField, bool kHasBaseHull, class Object>
Near MeshTouchedWith<kHasField, kHasBaseHull, Object>::near(Vec3 x_m, query::Budget budget,
                                                            float needed_m) const {
  Near near;
  near.has_inside = object.mesh->is_signed();
  const Vec3 p_m = math::apply_inverse(object.pose, x_m);
  const float loss_m = pose_loss_m(object.pose, x_m);
  if (budget.threshold_m > 0.0f) budget.threshold_m += loss_m;
  mesh::Closest closest;
  bool is_far = false;
  if (kHasField && object.distance_field != nullptr && object.distance_field->is_open()) {
    const field::Answer answer = field::closest_point(*object.distance_field, *object.mesh, p_m,
                                                      budget.band_m, budget, hint);
    closest = answer.closest;
    is_far = answer.is_far;
  } else {
    closest = mesh::closest_point(*object.mesh, p_m, budget, hint);
  }
  const query::Certificate& certificate = closest.certificate;
  // A search for the side that was cut short begins anew: a cold one raises its bound fastest.
  if (!(budget.band_m < FLT_MAX) && !certificate.exact) hint.leaf_slot = query::kNowhere;
  near.lower_m = certificate.lower_m > loss_m ? certificate.lower_m - loss_m : 0.0f;
  near.distance_m = closest.distance_m < 0.0f ? -closest.distance_m : closest.distance_m;
  near.sign = certificate.sign;
  near.is_exact = certificate.exact;
  near.steps = certificate.steps;
  near.work = certificate.work;
  near.outward = math::turn(object.pose, closest.direction);
  // Beyond the band the point may be any of the surface.
  if (!is_far && (certificate.exact || near.distance_m <= budget.band_m)) {
    use_triangle(object, closest.triangle, near.feature);
    if constexpr (__is_same(Object, MaterialMeshObject))
      near.feature.material = object.materials->of(closest.triangle);
  }
  if constexpr (kHasBaseHull) use_base_hull(object, p_m, budget, needed_m, loss_m, near);
  return near;
}

template struct MeshTouchedWith<false, false>;
template struct MeshTouchedWith<false, false, PlacedMesh>;
template struct MeshTouchedWith<true, false>;
template struct MeshTouchedWith<true, false, PlacedMesh>;
template struct MeshTouchedWith<false, true>;
template struct MeshTouchedWith<false, true, PlacedMesh>;
template struct MeshTouchedWith<true, true>;
template struct MeshTouchedWith<true, true, PlacedMesh>;
template struct MeshTouchedWith<false, false, MaterialMeshObject>;
template struct MeshTouchedWith<true, false, MaterialMeshObject>;
template struct MeshTouchedWith<false, true, MaterialMeshObject>;
template struct MeshTouchedWith<true, true, MaterialMeshObject>;

}  // namespace firmtouch::scene
