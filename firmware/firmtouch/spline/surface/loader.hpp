#pragma once
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/proof/sections.hpp"
#include "firmtouch/spline/surface/closest_on_surface.hpp"

namespace firmtouch::spline {

/// Proves spline surfaces and runs their probe queries (asset/loading.hpp).
class SurfaceLoader {
 public:
  using State = core::OneOf<Opening, SurfaceProbeRun>;
  static const char* find(const asset::Container& asset, const char* wanted);
  void close() { view_ = {}; }
  void begin(const asset::Container& asset, const char* name, State& state);
  /// Bounds: a probe query is one slice.
  asset::Progress work(State& state, uint32_t budget);
  /// Open once proven.
  const View& view() const { return view_; }

 private:
  View view_;
  core::Bytes probes_;
};

}  // namespace firmtouch::spline
