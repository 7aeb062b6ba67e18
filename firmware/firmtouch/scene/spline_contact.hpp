#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::scene {

/// Spline surfaces, their pose (their frame to device frame) and their material.
struct SplineObject {
  const spline::View* surface = nullptr;
  math::RigidTransform pose;
  Material material;
  // False: the normals point to the free side; true: away from it.
  bool is_turned = false;
  // True: the surfaces enclose a solid, and a tool inside is pushed out. False: they are sheets, and
  // push only a tool that came from their free side.
  bool is_closed = false;
};

/// State of a (tool, object) pair between ticks, and its last answer. The caller owns one a pair.
struct SplineTouch {
  spline::Hint hint;
  spline::Closest closest;           // the object's frame; certificate.sign is set here
  math::Vec3 normal;                 // of the plane, device frame; 0 with an unknown sign
  float penetration_m = 0;           // of the sphere; 0 in free space and with an unknown sign
  bool came_from_free_side = false;  // of a sheet
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame), as touch_mesh().
///
/// Sign: from the normal if the line to the closest point is within 11 degrees of it. Elsewhere (at
/// a crease, a border or a pole) it is carried on through certified free distance only. No plane is
/// made from an unknown sign.
/// Sheet: pushes a tool that was clear of it on its free side, however deep it is pressed through.
/// Contact ends when a border (or a crease that points to the tool) is nearest behind the sheet, or
/// when a tick moves the tool by more than the radius and 2 % of the extent.
///
/// Bounds: one query of at most `budget`, and about 250 instructions; re-entrant for different
///         touches.
void touch_spline(const SplineObject& object, float radius_m, math::Vec3 position_m,
                  query::Budget budget, SplineTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
