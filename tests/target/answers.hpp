#pragma once
#include <stdint.h>

#include "target/scene_views.hpp"

namespace firmtouch::target {

/// Hash of every bit of `count` answers about the mesh and the curve of an asset: a touching path,
/// scattered points, far ones, hostile ones; warm and cold; every budget. Every compiler,
/// optimisation level and target must give the same.
uint64_t hash_answers(const Views& views, uint32_t count);

}  // namespace firmtouch::target
