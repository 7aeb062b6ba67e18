#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/math/vec3.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {

/// Points spread evenly in 1.5 times the box of a head.
template <class Head>
std::vector<math::Vec3> points_about(const Head& head, size_t count, uint64_t seed) {
  tools::Random random(seed);
  std::vector<math::Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    float at[3];
    for (int k = 0; k < 3; ++k) {
      const double low = static_cast<double>(head.low_m[k]);
      const double high = static_cast<double>(head.high_m[k]), margin = 0.25 * (high - low);
      at[k] = static_cast<float>(random.between(low - margin, high + margin));
    }
    points.push_back({at[0], at[1], at[2]});
  }
  return points;
}

}  // namespace firmtouch::bench
