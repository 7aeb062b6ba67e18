#pragma once
#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/loading.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// The sections of the spline model `name`, as Opening takes them. One that the asset lacks is
/// empty.
/// Bounds: a search of the section table each; no memory is copied.
Sections find_sections(const asset::Container& asset, const char* name);

/// The first model of surfaces, or of curves with lengths, or `wanted` if it is one; null: there is
/// none. What the head says is not yet proven.
const char* find_kind(const asset::Container& asset, const char* wanted, bool is_surface);

/// One probe query in a loader's slice.
template <class ProbeRun>
asset::Progress work_probe(ProbeRun& run, const View& model) {
  run.work(model);
  if (!run.done()) return {};
  return {true, run.agrees() ? core::kPassed : core::reject(kRuleSplineProbes)};
}

}  // namespace firmtouch::spline
