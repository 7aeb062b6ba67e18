#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "firmtouch/spline/surface/closest_on_surface.hpp"

namespace firmtouch::scene {

/// Spline surfaces, their pose (their frame to device frame) and their material.
struct SplineObject {
  const spline::View* surface = nullptr;
  math::RigidTransform pose;
  Material material;
  bool is_turned = false;  // false: the free side is where the normals point; true: the other one
  // true: the surfaces enclose a solid, and a tool inside is pushed out. false: they are sheets,
  // with no force from behind.
  bool is_closed = false;
};

/// State of a (tool, object) pair from tick to tick, and the result of its last query. The caller
/// owns one a pair.
struct SplineTouch {
  spline::Hint hint;
  spline::Closest closest;       // the object's frame; certificate.sign is the side
  math::Vec3 normal;             // of the plane, device frame; 0 if the sign is unknown
  float penetration_m = 0;       // of the sphere; 0 in free space, and if the sign is unknown
  bool is_from_outside = false;  // of a sheet: the tool was clear of it on its free side
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame), as touch_mesh().
/// The sign comes from the normal if the line to the closest point is along it. Elsewhere (at a
/// crease, a border or a pole) the last sign holds, through certified free distance alone. No plane
/// is made for an unknown sign.
/// A sheet pushes a tool that was clear of it on its free side, however deep the tool is pressed.
/// It stops when a border, or a crease that points to the tool, is nearest behind it, or when a
/// tick jumps farther than the radius plus 2 % of the extent.
/// Bounds: one query of at most `budget` units, and about 480 instructions; re-entrant for
/// different touches.
void touch_spline(const SplineObject& object, float radius_m, math::Vec3 position_m,
                  query::Budget budget, SplineTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
