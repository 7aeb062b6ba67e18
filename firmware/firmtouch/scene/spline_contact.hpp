#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::scene {

/// Spline surfaces, where they lie (pose: their frame to device frame) and how they feel.
struct SplineObject {
  const spline::View* surface = nullptr;
  math::RigidTransform pose;
  Material material;
  // The free side is the one to which normals point; true: the other one.
  bool is_turned = false;
  // The surfaces enclose what they bound, and a tool in it is pushed out. Else they are sheets: from
  // behind nothing is felt.
  bool is_closed = false;
};

/// What a (tool, object) pair remembers from tick to tick, and what its last query said. The caller
/// owns one a pair.
struct SplineTouch {
  spline::Hint hint;
  spline::Closest closest;  // the object's frame; certificate.sign is the side
  math::Vec3 normal;        // of the plane, device frame; 0 without a side
  float penetration_m = 0;  // of the sphere; 0 in free space, and where the side is unknown
  bool is_ahead = false;    // of a sheet: the tool came to it from its free side
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame), as touch_mesh(). The side
/// is told by the normal where the line to the closest point is along it, and goes on by continuity
/// where it is not (at a crease, a border or a pole): through certified free distance alone. Never
/// pushes on an unknown side. A sheet is felt by a tool that was clear of it on its free side, however
/// deep it is pressed through, till a border (or a crease that points to the tool) is nearest behind it, or
/// a tick leaps farther than its radius and 2 % of the extent.
/// Bounds: one query of at most `budget` steps, and about 250 instructions; re-entrant for
/// different touches.
void touch_spline(const SplineObject& object, float radius_m, math::Vec3 position_m,
                  query::Budget budget, SplineTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
