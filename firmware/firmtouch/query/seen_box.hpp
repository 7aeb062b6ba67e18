#pragma once
#include <stdint.h>

namespace firmtouch::query {

/// Smallest box of the points so far, to compare with the one that a head states.
class SeenBox {
 public:
  /// Takes points of three floats each.
  /// Result: how many come before the first that is outside the stated box, or NaN.
  uint32_t take(const float* points_m, uint32_t count, const float* low_m, const float* high_m);
  /// Result: the first side of the stated box, of low x, y, z, high x, y, z, that no point touches;
  /// 6 where there is none.
  uint32_t untouched_side(const float* low_m, const float* high_m) const;

 private:
  static constexpr float kMax_m = 0x1p127f;
  float low_m_[3] = {kMax_m, kMax_m, kMax_m}, high_m_[3] = {-kMax_m, -kMax_m, -kMax_m};
};

}  // namespace firmtouch::query
