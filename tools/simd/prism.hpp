#pragma once
#include "firmtouch/math/vec3.hpp"
#include "simd/wide_tree.hpp"

namespace firmtouch::simd {

/// The prism of a triangle (simd/search/prism_bound.hpp), a float for each of its arrays. Vectors
/// that rounding makes wrong, as a needle's, are 0.
void put_prism(math::Vec3 a_m, math::Vec3 b_m, math::Vec3 c_m, float (&row)[kPrismArrays]);

}  // namespace firmtouch::simd
