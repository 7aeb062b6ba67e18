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

/// What guide policies share.
template <class Loader, class Touch, uint32_t kPart>
class GuideWith : public Loader {
 public:
  using Parameters = params::Groups<params::GuideRows>;
  static constexpr bool kIsGuide = true;
  static constexpr uint32_t kParts = kPart;

  bool is_open() const { return this->view().is_open(); }
  void reset() { touch_ = {}; }

 protected:
  Touch touch_;
};

/// A guide policy: a sampled curve.
class CurveGuide : public GuideWith<curve::Loader, scene::CurveGuideTouch, kPartGuide> {
 public:
  const curve::View& curve() const { return view(); }
  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result);
};

}  // namespace firmtouch
