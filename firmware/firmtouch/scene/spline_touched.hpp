#pragma once
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/scene/touched.hpp"

namespace firmtouch::scene {

/// Spline surfaces as a shape that a proxy touches. Sheets are touched from both sides.
struct SplineTouched {
  const SplineObject& object;
  spline::Hint& hint;  // of the (tool, object) pair

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
};

}  // namespace firmtouch::scene
