#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "firmtouch/spline/proof/sections.hpp"
#include "firmtouch/spline/surface/closest_on_surface.hpp"

namespace firmtouch::spline {

/// Proves spline surfaces and runs their probe queries.
class SurfaceLoader : public asset::Loader<Proof, SurfaceProbeRun, kHeadSection, kProbesSection,
                                           kRuleSplineProbes> {
 public:
  static const char* find(const asset::Container& asset, const char* wanted) {
    return find_kind(asset, wanted, true);
  }
};

}  // namespace firmtouch::spline
