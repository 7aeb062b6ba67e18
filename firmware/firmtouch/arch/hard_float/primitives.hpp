#pragma once
// Any processor with a square root of its own: x86-64, AArch64, RISC-V F. For the library's own
// translation units.

#include "firmtouch/arch/portable/shared.hpp"

namespace firmtouch::math {

using portable::box_point;
using portable::BoxPoint;
using portable::grid_point;
using portable::side_distances2;

/// Correctly rounded by the processor.
static inline float square_root(float value) { return __builtin_sqrtf(value); }

}  // namespace firmtouch::math
