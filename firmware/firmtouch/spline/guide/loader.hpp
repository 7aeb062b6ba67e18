#pragma once
#include <stdint.h>

#include "firmtouch/core/one_of.hpp"
#include "firmtouch/spline/curve/closest_on_curve.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/proof/sections.hpp"

namespace firmtouch::spline {

GuideSections find_guide_sections(const asset::Container& asset, const char* name);

/// Proves spline curves with the lengths that a guide needs, and runs their probe queries.
class GuideLoader {
 public:
  using State = core::OneOf<Opening, GuideOpening, CurveProbeRun>;
  static const char* find(const asset::Container& asset, const char* wanted);
  void close() { view_ = {}; }
  void begin(const asset::Container& asset, const char* name, State& state);
  /// Bounds: a probe query is one slice.
  asset::Progress work(State& state, uint32_t budget);
  /// Open once proven.
  const GuideView& view() const { return view_; }

 private:
  enum class Stage : uint8_t { kModel, kLengths, kProbes };
  asset::Progress start_lengths(State& state);
  asset::Progress start_probes(State& state);

  GuideView view_;
  GuideSections sections_;
  core::Bytes probes_;
  Stage stage_ = Stage::kModel;
};

}  // namespace firmtouch::spline
