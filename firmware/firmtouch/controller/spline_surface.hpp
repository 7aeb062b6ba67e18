#pragma once
#include <stdint.h>

#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/controller/proxy_surface.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/spline_contact.hpp"
#include "firmtouch/spline/surface/loader.hpp"

namespace firmtouch {

/// A surface policy: spline surfaces.
class SplineSurface : public spline::SurfaceLoader {
 public:
  using Parameters = params::Groups<params::ContactRows, params::FrictionRows, params::SheetRows>;
  using PenaltyTouch = scene::SplineTouch;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = kPartSpline;

  const spline::View& surface() const { return view(); }
  bool is_open() const { return surface().is_open(); }
  /// Of the last model; unused under penalty contact.
  const SurfaceTouch& contact() const { return touch_; }
  void reset() {
    touch_ = {};
    hint_ = {};
  }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;

 private:
  scene::SplineObject object(const ModelRequest& request, const params::Values& values) const;

  SurfaceTouch touch_;
  spline::Hint hint_;
};

}  // namespace firmtouch
