#include "bench/all_benches.hpp"
#include "bench/bench.hpp"

namespace firmtouch::bench {

const std::vector<Bench>& benches() {
  static const std::vector<Bench> all = {
      {"curve", "guides along recorded curves: the bars, time against samples and N", run_curve},
      {"distance", "closest points of meshes: the bars, budgets, bytes", run_distance},
      {"orders", "query orders, upper bounds and kinds of boxes, each with each", run_orders},
      {"pseudonormals", "sides told by every pseudonormal proposed, on figures and models",
       run_pseudonormals},
      {"pyramids", "margins of the sign on slender pyramids, stored and not", run_pyramids},
      {"truth", "distances and sides against brute force in double", run_truth},
      {"grid", "Table 1 of Baerentzen & Aanaes: trees, grids and signs, two kinds of boxes",
       run_grid},
      {"ring", "records from thread to thread: the lock-free ring, a locked deque, a peer",
       run_ring},
      {"morris", "interior distance fields: the table of Morris, the bar", run_morris},
      {"hulls", "progressive hulls: time, void, limits, segments by base size", run_hulls},
      {"hull-queries",
       "queries of a baked hull: table 4 beside k-DOP and AABB trees, memory, shells",
       run_hull_queries},
      {"segment", "segments through meshes: first, any and every crossing", run_segment},
      {"splines", "foot-points of splines carried along, at the published parameters", run_splines},
      {"cells", "planar splines: cells that list what may be nearest, beside the tree", run_cells},
  };
  return all;
}

}  // namespace firmtouch::bench
