#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/spline/view.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {

/// Whether an edge of a surface's piece is one point, a pole: no longer than 1e-5 of the longest
/// edge. `coefficients`: the piece's own. `at_m`: that point, in the model's frame.
bool has_pole(const spline::Piece& piece, const float* coefficients, Point& at_m);

/// Units that a query of a ball takes near its pole, where it still is exact
/// (spline.AQueryOnTheAxisOfABallEndsWithin16000Units).
constexpr uint32_t kPoleWork = 16000;

/// The poles of all surfaces, each once.
std::vector<Point> poles_of(const spline::View& model);

}  // namespace firmtouch::tools
