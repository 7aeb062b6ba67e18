#include "bench/all_benches.hpp"
#include "bench/bench.hpp"

namespace firmtouch::bench {

std::vector<Bench> benches() {
  return {
      {"distance", "closest points of meshes: time, budgets, bytes", run_distance},
      {"certificates", "bounds of meshes under short budgets", run_certificates},
      {"truth", "distances and signs against brute force in double", run_truth},
      {"segment", "segments through meshes: first, any and every crossing", run_segment},
      {"hull-queries", "queries of a baked hull: crossings, memory, base hulls", run_hull_queries},
      {"field", "the interior distance field of a mesh: time", run_field},
      {"curve", "guides along recorded curves: time, bytes, jumps of the force", run_curve},
      {"spline-race", "closest points of splines: time against another library", run_spline_race},
      {"touch", "contact through a proxy: crossings, energy, queries a tick", run_touch},
      {"ring", "records from thread to thread: the lock-free ring, a locked deque", run_ring},
      {"velocity", "velocity estimators on encoder counts: errors", run_velocity},
  };
}

}  // namespace firmtouch::bench
