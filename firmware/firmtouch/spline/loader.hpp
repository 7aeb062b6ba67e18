#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/core/one_of.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/guide_view.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// The sections of the spline model `name`, as Opening takes them. One that the asset lacks is empty.
/// Bounds: a search of the section table each; no memory is copied.
Sections find_sections(const asset::Container& asset, const char* name);
GuideSections find_guide_sections(const asset::Container& asset, const char* name);

/// Proves spline surfaces and runs their probe queries (asset/loading.hpp).
class SurfaceLoader {
 public:
  using State = core::OneOf<Opening, ProbeRun>;
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

/// Proves spline curves with the lengths that a guide needs, and runs their probe queries.
class GuideLoader {
 public:
  using State = core::OneOf<Opening, GuideOpening, ProbeRun>;
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
