#pragma once
#include "bench/baked_hull.hpp"
#include "bench/report.hpp"

namespace firmtouch::bench {

/// What fixed memory costs: first hits by how many vertices may be split.
void run_memory(const Model& model, const Baked& baked, Report& report);
/// Shells, what they are for: a segment that misses one reads nothing else.
void run_base_hulls(const Model& model, const Baked& baked, Report& report);

}  // namespace firmtouch::bench
