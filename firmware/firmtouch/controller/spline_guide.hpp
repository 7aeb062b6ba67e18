#pragma once
#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/scene/spline_guide.hpp"
#include "firmtouch/spline/guide/loader.hpp"

namespace firmtouch {

/// A guide policy: spline curves.
class SplineGuide
    : public GuideWith<spline::GuideLoader, scene::SplineGuideTouch, kPartSplineGuide> {
 public:
  const spline::GuideView& guide() const { return view(); }
  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result);
};

}  // namespace firmtouch
