#include "firmtouch/scene/curve_guide.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// Some unit vector at right angles to the unit vector `u`: across the axis that it leans on least.
Vec3 any_across(Vec3 u) {
  const float x = u.x < 0.0f ? -u.x : u.x, y = u.y < 0.0f ? -u.y : u.y, z = u.z < 0.0f ? -u.z : u.z;
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 side = math::cross(u, axis);
  return side * (1.0f / math::length(side));
}

// The way along which the tool is free: the tangent, turned to be across the line from the closest
// point to the tool. On a segment it is so already; at a corner or past an end this is what makes
// the whole distance count.
Vec3 free_direction(const curve::Closest& c, Vec3 p_m, float diagonal_m) {
  const Vec3 off = p_m - c.point_m;
  const float size_m = math::length(off);
  if (!(size_m > 1e-5f * diagonal_m))
    return c.tangent;  // too near for a direction, and for a force
  const Vec3 u = off * (1.0f / size_m);
  const Vec3 turned = c.tangent - u * math::dot(c.tangent, u);
  const float turned_size = math::length(turned);
  return turned_size > 1e-3f ? turned * (1.0f / turned_size) : any_across(u);
}

}  // namespace

void follow_curve(const CurveGuide& guide, Vec3 position_m, query::Budget budget, GuideTouch& touch,
                  servo::LocalModel& model) {
  touch.closest = {};
  if (guide.curve == nullptr || !guide.curve->is_open()) {
    touch.is_held = false;
    return;
  }
  const Vec3 p_m = math::apply_inverse(guide.pose, position_m);
  touch.closest = curve::closest_point(*guide.curve, p_m, budget, touch.hint);
  const float off_m = touch.closest.distance_m;
  // Written so that NaN lets go. A release nearer than the snap would chatter: the farther of the
  // two counts.
  const bool is_near = off_m <= guide.snap_m;
  touch.is_held = is_near || (touch.is_held && off_m <= guide.release_m);
  if (!touch.is_held) return;
  servo::GuideLine line;
  line.point_m = math::apply(guide.pose, touch.closest.point_m);
  line.direction =
      guide.pose.rotation * free_direction(touch.closest, p_m, guide.curve->head().diagonal_m);
  line.stiffness_N_per_m = guide.material.stiffness_N_per_m;
  line.damping_N_s_per_m = guide.material.damping_N_s_per_m;
  (void)add_guide(model, line);  // a model that has a guide already keeps it
}

}  // namespace firmtouch::scene
