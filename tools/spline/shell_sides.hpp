#pragma once
#include <cstddef>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Of closed shells, each of surfaces of the model, to which side their normals point (is_turned
/// counts): 1 away from what they enclose together, -1 into it, 0 if that is unknown (they touch or
/// cross). What lies within a shell is a cavity, within that a solid again. Deterministic.
std::vector<int> sides_of_shells(const SplineModel& model,
                                 const std::vector<std::vector<size_t>>& shells);

}  // namespace firmtouch::tools
