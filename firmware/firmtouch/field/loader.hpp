#pragma once
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/field/view.hpp"

namespace firmtouch::field {

/// Proves the distance field of a mesh (asset/loading.hpp). It has no probes: its proof queries the
/// mesh at every cell.
using Loader = asset::PartLoader<Proof, kHeadSection, mesh::View>;

}  // namespace firmtouch::field
