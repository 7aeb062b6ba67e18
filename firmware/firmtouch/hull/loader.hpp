#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/hull/probes.hpp"

namespace firmtouch::hull {

/// Proves the hull of a mesh and runs its probe queries.
using Loader = asset::Loader<Proof, ProbeRun, kHeadSection, kProbesSection, kRuleHullProbes>;

}  // namespace firmtouch::hull
