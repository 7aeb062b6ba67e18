#include "firmtouch/scene/mesh_contact.hpp"

#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// A closest point is good to 3.5e-7 of the diagonal. At 1e-4 of the diagonal the direction to it is
// good to 4e-3 rad; at 1e-5 it is not worth having. In between the two are mixed, so that no step
// is felt.
constexpr float kOwnDirection = 1e-4f;
constexpr float kPseudonormal = 1e-5f;

// Outward unit normal at the closest point `c`, mesh frame. Both candidates lie in the normal cone
// of one feature, less than a right angle apart, so that their mix has a length.
Vec3 contact_normal(const mesh::Closest& c, Vec3 p_m, float diagonal_m) {
  const Vec3 off = p_m - c.point_m;
  const float size_m = math::length(off);
  const float own =
      (size_m - kPseudonormal * diagonal_m) / ((kOwnDirection - kPseudonormal) * diagonal_m);
  if (!(own > 0.0f)) return c.direction;
  const float side = c.certificate.sign > 0 ? 1.0f : -1.0f;
  const Vec3 outward = off * (side / size_m);
  if (own >= 1.0f) return outward;
  const Vec3 mix = outward * own + c.direction * (1.0f - own);
  const float mix_size = math::length(mix);
  return mix_size > 0.1f ? mix * (1.0f / mix_size) : c.direction;
}

// How far beyond the sphere the surface is looked for while the tool is free, beside the diagonal:
// many times what a hand moves while a model lives.
constexpr float kAhead = 0.02f;

mesh::Closest ask(const MeshObject& object, Vec3 p_m, float reach_m, query::Budget budget,
                  query::Hint& hint) {
  if (object.map == nullptr || !object.map->is_open())
    return mesh::closest_point(*object.mesh, p_m, budget, hint);
  return field::closest_point(*object.map, *object.mesh, p_m, reach_m, budget, hint).closest;
}

}  // namespace

void touch_mesh(const MeshObject& object, float radius_m, Vec3 position_m, query::Budget budget,
                MeshTouch& touch, servo::LocalModel& model) {
  touch.penetration_m = 0;
  touch.normal = {};
  touch.closest = {};
  if (object.mesh == nullptr || !object.mesh->is_open()) return;
  const Vec3 p_m = math::apply_inverse(object.pose, position_m);
  // Certainly outside a moment ago: what is farther off than the sphere may reach need not be known.
  const float reach_m = radius_m + kAhead * object.mesh->head().diagonal_m;
  if (touch.hint.sign > 0 && reach_m < budget.band_m) budget.band_m = reach_m;
  touch.closest = ask(object, p_m, reach_m, budget, touch.hint);
  const query::Certificate& certificate = touch.closest.certificate;

  SurfacePoint surface;
  surface.sign = certificate.sign;
  surface.lower_m = certificate.lower_m;
  surface.distance_m = touch.closest.distance_m;
  if (certificate.sign < 0 && !certificate.exact) surface.distance_m = -certificate.lower_m;
  // Nothing within reach: which way the surface lies is not known, and not needed.
  if (!certificate.exact && certificate.lower_m >= 0.99f * reach_m) surface.sign = 0;
  if (surface.sign != 0) {
    touch.normal =
        object.pose.rotation * contact_normal(touch.closest, p_m, object.mesh->head().diagonal_m);
  }
  surface.normal = touch.normal;
  touch.penetration_m = add_contact(model, position_m, radius_m, surface, object.material);
}

}  // namespace firmtouch::scene
