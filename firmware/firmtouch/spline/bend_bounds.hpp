#pragma once
#include "firmtouch/spline/leaf_shape.hpp"

namespace firmtouch::spline {

/// Bounds the third derivatives of D^2 / 2 over a leaf: fills fixed and turning. `noise_m`, `noise_w`:
/// by which a coefficient of the numerator, or of the weight, may be off, times the powers of the
/// part's halves that belong to it.
/// Pre: all else of the shape is known, least_weight above 1 / 2.
void bound_bends(const Part& part, float noise_m, float noise_w, LeafShape& shape);

}  // namespace firmtouch::spline
