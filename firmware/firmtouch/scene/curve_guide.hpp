#pragma once
#include "firmtouch/scene/guide.hpp"

namespace firmtouch::scene {

/// A guide along a sampled curve.
struct CurveGuide : Guide {
  const curve::View* curve = nullptr;
};

struct CurveGuideTouch : GuideTouch {
  curve::Following following;
};

/// Ties the tool at `position_m` (device frame) to the curve, across it; along it the tool is free,
/// or driven. At a corner, and past an end that holds, the pull is to that point, so that the force
/// has no jump. curve::follow() finds the part of the curve.
/// Bounds: one query of `budget`, and about 570 instructions; re-entrant for different touches.
/// Result: a sound model if the material is sound. NaN in the guide's settings counts as 0. Without
///         a drive no force does work on a tool that returns to where it was, except the snap,
///         which gives stiffness snap^2 / 2. From tick to tick the line is another one: what that
///         gives, servo limits (servo/energy.hpp). A drive gives at most its force times the
///         length.
void follow_curve(const CurveGuide& guide, math::Vec3 position_m, query::Budget budget,
                  CurveGuideTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
