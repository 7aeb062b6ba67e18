#pragma once
#include <stdint.h>

#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/curve/loader.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/curve_guide.hpp"

namespace firmtouch {

/// Fills a guide's settings from the parameters. `ticks`: since the last model.
void set_guide(const ModelRequest& request, const params::Values& values, uint32_t ticks,
               scene::Guide& guide);
void report_guide(const scene::GuideTouch& touch, ModelResult& result);

/// A guide policy: a sampled curve.
class CurveGuide : public curve::Loader {
 public:
  using Parameters = params::Groups<params::GuideRows>;
  static constexpr bool kIsGuide = true;
  static constexpr uint32_t kParts = kPartGuide;

  const curve::View& curve() const { return view(); }
  bool is_open() const { return curve().is_open(); }
  void reset() { touch_ = {}; }
  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result);

 private:
  scene::CurveGuideTouch touch_;
};

}  // namespace firmtouch
