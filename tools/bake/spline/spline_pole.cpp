#include "bake/spline/spline_pole.hpp"

#include <algorithm>
#include <cmath>

#include "bake/spline/piece_point.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kPoint = 1e-5;     // of the longest edge of a piece
constexpr int kSamples = 8;         // of an edge
constexpr double kSamePole = 1e-5;  // of the extent

}  // namespace

bool has_pole(const spline::Piece& piece, const float* coefficients, Point& at_m) {
  double shortest = HUGE_VAL, longest = 0;
  for (int edge = 0; edge < 4; ++edge) {
    const double side = edge % 2 == 0 ? -1 : 1;
    const auto point_at = [&](int i) {
      const double along = 2.0 * i / kSamples - 1;
      return edge < 2 ? point_of_piece(piece, coefficients, along, side)
                      : point_of_piece(piece, coefficients, side, along);
    };
    double size = 0;
    const Point first = point_at(0);
    for (int i = 1; i <= kSamples; ++i) size = std::max(size, length(point_at(i) - first));
    longest = std::max(longest, size);
    if (!(size < shortest)) continue;
    shortest = size;
    at_m = first;
  }
  return shortest <= kPoint * longest;
}

std::vector<Point> poles_of(const spline::View& model) {
  std::vector<Point> poles;
  if (!model.is_surface()) return poles;
  const double near_m = kSamePole * static_cast<double>(model.head().extent_m);
  for (const spline::Piece& piece : model.pieces()) {
    Point at_m;
    if (!has_pole(piece, model.coefficients().data() + piece.coefficients, at_m)) continue;
    const auto is_same = [&](const Point& pole) { return length(pole - at_m) <= near_m; };
    if (std::none_of(poles.begin(), poles.end(), is_same)) poles.push_back(at_m);
  }
  return poles;
}

}  // namespace firmtouch::tools
