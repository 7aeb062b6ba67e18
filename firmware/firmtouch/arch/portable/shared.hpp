#pragma once
// What no target without the DSP extension replaces. For the primitives.hpp of such targets, and
// so for the library's own translation units.

#include "firmtouch/math/portable.hpp"

namespace firmtouch::math {

using portable::as_multiplier;
using portable::box_distance2;
using portable::count_down;
using portable::half_cell_point;
using portable::in_register;
using portable::larger;
using portable::load_floats;
using portable::load_kept;
using portable::next_of;
using portable::only_here;
using portable::oriented_distance2;
using portable::product_error;
using portable::push_pair;
using portable::saturated;
using portable::smaller;

}  // namespace firmtouch::math
