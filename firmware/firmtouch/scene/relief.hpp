#pragma once
#include "firmtouch/scene/texture.hpp"

// A baked height map: a periodic tile of depths below the triangle, by the tensor product of
// quadratic B-splines. The depth is C1, so the force makes no step; it is a mean of nine samples,
// so it stays within them, its slope within their differences, its curvature within the second
// ones. A sine of N samples a period comes out sinc(1 / N)^3 as high.
namespace firmtouch::scene {

/// What the samples may do anywhere.
struct ReliefBounds {
  float slope = 0;  // of the depth
  float per_m = 0;  // of the slope
};

/// Adds the map's depth and slope at `x_m`, in the mesh's frame. `samples`: of its section.
/// Bounds: about 320 instructions. Result: finite; NaN: as at x_m = 0.
void add_relief(const ReliefLayout& relief, const uint8_t* samples, math::Vec3 x_m, Cut& cut);

/// Pre: the map has a power of two of samples a side, as `samples` has from map.first on.
/// Bounds: about 165 instructions a sample.
ReliefBounds bounds_of(const ReliefLayout& relief, const uint8_t* samples);

}  // namespace firmtouch::scene
