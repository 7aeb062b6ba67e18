#pragma once
// Any processor, without a floating-point unit too. For the library's own translation units.

#include "firmtouch/arch/portable/shared.hpp"

namespace firmtouch::math {

using portable::box_point;
using portable::BoxPoint;
using portable::grid_point;
using portable::side_distances2;
using portable::square_root;

}  // namespace firmtouch::math
