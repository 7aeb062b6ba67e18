#pragma once
#include <stdint.h>

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/hint.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::scene {

/// A curve, where it lies (pose: curve frame to device frame), how it pulls, and when it takes hold
/// and lets go.
struct CurveGuide {
  const curve::View* curve = nullptr;
  math::RigidTransform pose;
  Material material;
  float snap_m = 0;     // nearer than this, the guide takes hold
  float release_m = 0;  // farther than this, and than snap_m, it lets go
};

/// What a (tool, guide) pair remembers from tick to tick, and what its last query said. The caller
/// owns one a pair.
struct GuideTouch {
  query::Hint hint;
  curve::Closest closest;  // curve frame
  bool is_held = false;
};

/// Pulls the tool at `position_m` (device frame) to the nearest point of the curve, across it only:
/// along the curve it is free. At a corner, and past an open end, the pull is to that point itself,
/// so that the force has no jump.
/// Bounds: one query of at most `budget` steps, and about 150 instructions; re-entrant for
/// different touches.
void follow_curve(const CurveGuide& guide, math::Vec3 position_m, query::Budget budget,
                  GuideTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
