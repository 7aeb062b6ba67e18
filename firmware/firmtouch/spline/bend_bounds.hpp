#pragma once
#include "firmtouch/spline/leaf_shape.hpp"

namespace firmtouch::spline {

/// Bounds the derivatives of D^2 / 2 over a part, of a curve the third, of a surface the fourth, by the
/// piece's s and t: fills fixed and turning.
/// Pre: the shape is the part's, its least_weight above 1 / 2.
void bound_bends(const Part& part, LeafShape& shape);

}  // namespace firmtouch::spline
