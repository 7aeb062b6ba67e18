#pragma once
// Any processor, without a floating-point unit too. For the library's own translation units.

#include "firmtouch/math/portable.hpp"

namespace firmtouch::math {

using portable::as_multiplier;
using portable::box_distance2;
using portable::box_point;
using portable::BoxPoint;
using portable::count_down;
using portable::grid_point;
using portable::half_cell_point;
using portable::larger;
using portable::load_floats;
using portable::load_kept;
using portable::next_of;
using portable::only_here;
using portable::oriented_distance2;
using portable::product_error;
using portable::push_pair;
using portable::saturated;
using portable::side_distances2;
using portable::smaller;
using portable::square_root;

}  // namespace firmtouch::math
