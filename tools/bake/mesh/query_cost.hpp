#pragma once
#include "bake/mesh/bake_mesh.hpp"

namespace firmtouch::tools {

/// The options given, or those without splits of long edges (max_growth 1), if queries along
/// touching paths of the surface then take 3 % less: where the splits end before all edges are
/// short, float32 alone is not enough, and the more triangles, the more are equally near.
/// Bounds: two bakes without sides and 80,000 queries, and none of them unless refine() splits
///         edges and float32 is not enough; the same on every machine.
MeshOptions without_needless_splits(const Surface& surface, const MeshOptions& options);

}  // namespace firmtouch::tools
