#pragma once
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Turns surfaces over (is_turned) until those that share a border have their normals on one side:
/// fewer of each shell than half. Borders are shared where they lie within 2e-5 of the extent of
/// each other, of the whole of one of them or of a part, however they are parametrised. Closed
/// shells that share none are turned to enclose one solid together. What was done, what has no two
/// sides, and what can only be as the file has it is stated in the model's notes. Deterministic.
void orient(SplineModel& model);

}  // namespace firmtouch::tools
