#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::tools {

/// Positions of a hand that is led along a curve once, from its first sample to its last, in equal
/// steps of arc length, and wanders up to 1 % of the diagonal aside in steps of 0.02 %. The same on
/// every machine.
std::vector<math::Vec3> make_hand_walk(const std::vector<math::Vec3>& samples_m, uint64_t seed,
                                       uint32_t points);

}  // namespace firmtouch::tools
