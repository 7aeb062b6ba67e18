#pragma once
#include "firmtouch/scene/guide.hpp"
#include "firmtouch/spline/guide/guided_point.hpp"

namespace firmtouch::scene {

/// A guide along spline curves.
struct SplineGuide : Guide {
  const spline::GuideView* spline = nullptr;
};

struct SplineGuideTouch : GuideTouch {
  spline::Following following;
};

/// As follow_curve(), by spline::follow().
void follow_spline(const SplineGuide& guide, math::Vec3 position_m, query::Budget budget,
                   SplineGuideTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
