#include "bake/spline/piece_point.hpp"

namespace firmtouch::tools {

Point point_of_piece(const spline::Piece& piece, const float* coefficients, double s, double t) {
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3, columns = piece.degree_u + 1u;
  double sum[4] = {0, 0, 0, piece.is_rational != 0 ? 0.0 : 1.0};
  for (uint32_t k = 0; k < stride; ++k)
    for (uint32_t j = piece.degree_v + 1u; j-- > 0;) {
      double row = 0;
      for (uint32_t i = columns; i-- > 0;)
        row = row * s + static_cast<double>(coefficients[(j * columns + i) * stride + k]);
      sum[k] = sum[k] * t + row;
    }
  const float(&o)[3] = piece.origin_m;
  return to_point({o[0], o[1], o[2]}) + Point{sum[0], sum[1], sum[2]} * (1 / sum[3]);
}

}  // namespace firmtouch::tools
