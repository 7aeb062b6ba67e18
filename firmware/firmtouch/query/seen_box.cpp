#include "firmtouch/query/seen_box.hpp"

#include "firmtouch/math/isa.hpp"

namespace firmtouch::query {

// An axis after the other: the four bounds of one stay in registers.
uint32_t SeenBox::take(const float* points_m, uint32_t count, const float* low_m,
                       const float* high_m) {
  uint32_t inside = count;
  for (uint32_t k = 0; k < 3; ++k) {
    const float least_m = low_m[k], most_m = high_m[k];
    float low = low_m_[k], high = high_m_[k];
    const float* at_m = points_m + k;
    for (uint32_t i = 0; i < inside; ++i, at_m += 3) {
      const float x_m = *at_m;
      if (!(x_m >= least_m && x_m <= most_m)) inside = i;
      low = math::smaller(x_m, low);
      high = math::larger(x_m, high);
    }
    low_m_[k] = low;
    high_m_[k] = high;
  }
  return inside;
}

uint32_t SeenBox::untouched_side(const float* low_m, const float* high_m) const {
  uint32_t side = 0;
  while (side < 6 &&
         (side < 3 ? low_m_[side] <= low_m[side] : high_m_[side - 3] >= high_m[side - 3]))
    ++side;
  return side;
}

}  // namespace firmtouch::query
