#include "bench/all_benches.hpp"
#include "bench/bench.hpp"

namespace firmtouch::bench {

const std::vector<Bench>& benches() {
  static const std::vector<Bench> all = {
      {"distance", "closest points of meshes: the bars, budgets, bytes", run_distance},
  };
  return all;
}

}  // namespace firmtouch::bench
