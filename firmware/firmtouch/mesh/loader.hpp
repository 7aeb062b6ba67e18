#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::mesh {

/// Proves the mesh of an asset and runs its probe queries.
using Loader = asset::Loader<Proof, ProbeRun, kHeadSection, kProbesSection, kRuleMeshProbes>;

}  // namespace firmtouch::mesh
