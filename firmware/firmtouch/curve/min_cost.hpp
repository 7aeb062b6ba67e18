#pragma once
#include "firmtouch/curve/guided_point.hpp"

namespace firmtouch::curve {

constexpr ArcPenalty kNoPenalty{0.0f, 0.0f, true};

/// The point of the least distance + penalty, for .cpp files of this module only: of a straight
/// curve for guided_point(), of a smooth one for closest_point(), too.
/// Pre: is_penalty(penalty) or kNoPenalty; the query is near.
Constraint min_cost(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                    query::Budget budget, Hint& hint);

/// The same of a straight curve whose nearest point is `found`, if few segments beside it may cost
/// less. Result: false, with the work charged, if many may.
bool min_cost_beside(const View& curve, math::Vec3 p_m, const ArcPenalty& penalty,
                     Constraint& found);

}  // namespace firmtouch::curve
