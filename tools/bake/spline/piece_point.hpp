#pragma once
#include "firmtouch/spline/view.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {

/// Point of a stored piece at (s, t), both in [-1, 1], in double.
Point point_of_piece(const spline::Piece& piece, const float* coefficients, double s, double t);

}  // namespace firmtouch::tools
