#include "firmtouch/scene/mesh_contact.hpp"

#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A closest point has an error of 3.5e-7 of the diagonal. At 1e-4 of the diagonal the direction to
// it has an error of 4e-3 rad; at 1e-5 it is useless. Between the two the normals are mixed, so
// that the force has no step.
constexpr float kOwnDirection = 1e-4f;
constexpr float kPseudonormal = 1e-5f;

// The closest point of a surface and its outward normal.
struct Nearest {
  Vec3 point_m, normal;
  int8_t sign;
};

// Outward unit normal at the closest point `c`, mesh frame. Both candidates are in the normal cone
// of one feature, less than a right angle apart, so their mix is not zero.
Vec3 contact_normal(const Nearest& c, Vec3 p_m, float diagonal_m) {
  const Vec3 off = p_m - c.point_m;
  const float size_m = math::length(off);
  const float own =
      (size_m - kPseudonormal * diagonal_m) / ((kOwnDirection - kPseudonormal) * diagonal_m);
  if (!(own > 0.0f)) return c.normal;
  const float side = c.sign > 0 ? 1.0f : -1.0f;
  const Vec3 outward = off * (side / size_m);
  if (own >= 1.0f) return outward;
  const Vec3 mix = outward * own + c.normal * (1.0f - own);
  const float mix_size = math::length(mix);
  return mix_size > 0.1f ? mix * (1.0f / mix_size) : c.normal;
}

// Band beyond the sphere, in diagonals: many times what a hand moves while a model is valid.
constexpr float kBand = 0.02f;

// A base hull of 1,000 faces needs a fifth of it (tests/scene/base_hull_contact_host_test.cpp). It
// serves ticks whose own budget is too small.
constexpr uint32_t kBaseHullWork = 1280;

mesh::Closest query_with_field(const MeshObject& object, Vec3 p_m, float reach_m,
                               query::Budget budget, mesh::Hint& hint) {
  if (object.distance_field == nullptr || !object.distance_field->is_open())
    return mesh::closest_point(*object.mesh, p_m, budget, hint);
  return field::closest_point(*object.distance_field, *object.mesh, p_m, reach_m, budget, hint)
      .closest;
}

// Replaces `surface` and `nearest` by the base hull's: no farther than the mesh is outside, no less
// deep inside.
// Result: false, nothing replaced, if the base hull's query has no result.
bool query_base_hull(const MeshObject& object, Vec3 p_m, query::Budget budget, MeshTouch& touch,
                     SurfacePoint& surface, Nearest& nearest) {
  if (object.base_hull == nullptr || !object.base_hull->is_open()) return false;
  const query::Budget own{budget.work > kBaseHullWork ? budget.work : kBaseHullWork};
  const hull::BaseHullDistance found = hull::base_hull_distance(*object.base_hull, p_m, own);
  touch.base_hull_steps = found.steps;
  if (found.side == hull::BaseHullSide::kUnknown) return false;
  const bool is_outside = found.side == hull::BaseHullSide::kOutside;
  if (!is_outside && !found.exact) return false;
  const query::Certificate& certificate = touch.closest.certificate;
  const float off_m = is_outside ? found.lower_m : -math::length(p_m - found.point_m);
  nearest = {found.point_m, found.normal, is_outside ? int8_t{1} : int8_t{-1}};
  surface.sign = nearest.sign;
  surface.distance_m = off_m;
  // What the mesh query has proven holds as well.
  if (certificate.sign > 0 && certificate.lower_m > off_m) surface.distance_m = certificate.lower_m;
  return true;
}

}  // namespace

template <bool kHasField, bool kHasBaseHull>
void touch_mesh(const MeshObject& object, float radius_m, Vec3 position_m, query::Budget budget,
                MeshTouch& touch, servo::LocalModel& model) {
  touch.penetration_m = 0;
  touch.normal = {};
  touch.closest = {};
  touch.is_of_base_hull = false;
  touch.base_hull_steps = 0;
  if (object.mesh == nullptr || !object.mesh->is_open()) return;
  const Vec3 p_m = math::apply_inverse(object.pose, position_m);
  const float diagonal_m = object.mesh->head().diagonal_m;
  // Certainly outside a moment ago: the surface matters only within the sphere's reach.
  const float reach_m = radius_m + kBand * diagonal_m;
  if (touch.hint.sign > 0 && reach_m < budget.band_m) budget.band_m = reach_m;
  if constexpr (kHasField) {
    touch.closest = query_with_field(object, p_m, reach_m, budget, touch.hint);
  } else {
    touch.closest = mesh::closest_point(*object.mesh, p_m, budget, touch.hint);
  }
  const query::Certificate& certificate = touch.closest.certificate;

  SurfacePoint surface;
  surface.sign = certificate.sign;
  surface.distance_m = touch.closest.distance_m;
  if (certificate.sign < 0 && !certificate.exact) surface.distance_m = -certificate.lower_m;
  // Outside, nothing within reach: the direction to the surface is unknown, and not needed. Inside,
  // a depth beyond reach is the deepest contact of all.
  const bool is_beyond =
      certificate.sign > 0 && !certificate.exact && certificate.lower_m >= 0.99f * reach_m;
  if (is_beyond) surface.sign = 0;
  Nearest nearest{touch.closest.point_m, touch.closest.direction, certificate.sign};
  if constexpr (kHasBaseHull) {
    if (!certificate.exact && !is_beyond)
      touch.is_of_base_hull = query_base_hull(object, p_m, budget, touch, surface, nearest);
  }
  if (surface.sign != 0)
    touch.normal = object.pose.rotation * contact_normal(nearest, p_m, diagonal_m);
  surface.normal = touch.normal;
  touch.penetration_m = add_contact(model, position_m, radius_m, surface, object.material);
}

template void touch_mesh<false, false>(const MeshObject&, float, Vec3, query::Budget, MeshTouch&,
                                       servo::LocalModel&);
template void touch_mesh<true, false>(const MeshObject&, float, Vec3, query::Budget, MeshTouch&,
                                      servo::LocalModel&);
template void touch_mesh<false, true>(const MeshObject&, float, Vec3, query::Budget, MeshTouch&,
                                      servo::LocalModel&);
template void touch_mesh<true, true>(const MeshObject&, float, Vec3, query::Budget, MeshTouch&,
                                     servo::LocalModel&);

}  // namespace firmtouch::scene
