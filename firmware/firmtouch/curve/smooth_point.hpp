#pragma once
#include "firmtouch/curve/guided_point.hpp"

namespace firmtouch::curve {

/// closest_point() and guided_point() of a smooth curve, for .cpp files of this module only.
/// Pre: the query is near.
Constraint smooth_point(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                        query::Budget budget, Hint& hint);

}  // namespace firmtouch::curve
