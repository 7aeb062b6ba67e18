#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/curve/closest_point.hpp"

namespace firmtouch::curve {

/// Proves the curve of an asset and runs its probe queries.
using Loader = asset::Loader<Proof, ProbeRun, kHeadSection, kProbesSection, kRuleCurveProbes>;

}  // namespace firmtouch::curve
