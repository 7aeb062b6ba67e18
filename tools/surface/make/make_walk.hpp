#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A touching path: `points` points, 0.0005 of the diagonal from one to the next, which keep to the
/// surface as a touching hand does, on both of its sides: never farther than 2 % of the diagonal,
/// on average a tenth of a percent. `closest` gives a closest point of the surface (an error of 0.1
/// % of the diagonal does no harm); it is called every second step.
std::vector<math::Vec3> make_walk(const Surface& surface, uint64_t seed, uint32_t points,
                                  const std::function<math::Vec3(math::Vec3)>& closest);

}  // namespace firmtouch::tools
