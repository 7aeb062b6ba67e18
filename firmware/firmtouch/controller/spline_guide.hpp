#pragma once
#include <stdint.h>

#include "firmtouch/controller/curve_guide.hpp"
#include "firmtouch/scene/spline_guide.hpp"
#include "firmtouch/spline/guide/loader.hpp"

namespace firmtouch {

/// A guide policy: spline curves.
class SplineGuide : public spline::GuideLoader {
 public:
  using Parameters = params::Groups<params::GuideRows>;
  static constexpr bool kIsGuide = true;
  static constexpr uint32_t kParts = kPartSplineGuide;

  const spline::GuideView& guide() const { return view(); }
  bool is_open() const { return guide().is_open(); }
  void reset() { touch_ = {}; }
  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result);

 private:
  scene::SplineGuideTouch touch_;
};

}  // namespace firmtouch
