#include "firmtouch/query/seen_box.hpp"

#include "firmtouch/math/isa.hpp"

namespace firmtouch::query {

// An axis after the other: what a loop needs stays in registers. The sum is NaN if a point is.
uint32_t SeenBox::take(const float* points_m, uint32_t count, const float* low_m,
                       const float* high_m) {
  uint32_t inside = count;
  for (uint32_t k = 0; k < 3; ++k) {
    const float least_m = low_m[k], most_m = high_m[k];
    float low = low_m_[k], high = high_m_[k], sum = 0.0f;
    const float *at_m = points_m + k, *const end_m = at_m + 3 * inside;
    if (inside != 0) {
      do {
        low = math::smaller(*at_m, low);
        high = math::larger(*at_m, high);
        sum += *at_m;
        at_m += 3;
      } while (at_m != end_m);
    }
    low_m_[k] = low;
    high_m_[k] = high;
    if (low >= least_m && high <= most_m && !__builtin_isnan(sum)) continue;
    for (uint32_t i = inside; i-- > 0;)
      if (!(points_m[3 * i + k] >= least_m && points_m[3 * i + k] <= most_m)) inside = i;
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
