#pragma once
#include <stdint.h>

#include "firmtouch/spline/layout.hpp"

namespace firmtouch::spline_test {

/// A point of a stored piece at s, t, from the asset's coefficients, in double.
inline void stored_point(const spline::Piece& piece, const float* coefficients, double s, double t,
                         double (&at)[3]) {
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  const float* next = coefficients + piece.coefficients;
  double sum[4] = {0, 0, 0, piece.is_rational != 0 ? 0.0 : 1.0}, power_t = 1;
  for (uint32_t j = 0; j <= piece.degree_v; ++j, power_t *= t) {
    double power = power_t;
    for (uint32_t i = 0; i <= piece.degree_u; ++i, power *= s)
      for (uint32_t k = 0; k < stride; ++k) sum[k] += power * static_cast<double>(*next++);
  }
  for (uint32_t k = 0; k < 3; ++k) at[k] = static_cast<double>(piece.origin_m[k]) + sum[k] / sum[3];
}

}  // namespace firmtouch::spline_test
