#pragma once
#include <stdint.h>

#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/spline/surface/loader.hpp"

namespace firmtouch {

/// A surface policy: spline surfaces.
class SplineSurface : public spline::SurfaceLoader {
 public:
  using Parameters = params::Groups<params::ContactRows, params::SheetRows>;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = kPartSpline;

  const spline::View& surface() const { return view(); }
  bool is_open() const { return surface().is_open(); }
  void reset() { touch_ = {}; }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);

 private:
  scene::SplineTouch touch_;
};

}  // namespace firmtouch
