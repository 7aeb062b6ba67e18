#pragma once
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::tools {

/// On which side of the plane through a, b, c the point p lies: 1 on the outer one (from which a,
/// b, c run counter-clockwise), -1 on the inner one, 0 on the plane. Exact: where doubles do not
/// settle it, whole numbers of 128 or, if these are too short, 576 bits do.
/// Pre: every coordinate is finite and smaller than 2^24 m (the check of a surface refuses
///         others).
int exact_side(math::Vec3 a, math::Vec3 b, math::Vec3 c, math::Vec3 p);

}  // namespace firmtouch::tools
