#pragma once
#include "firmtouch/spline/leaf_shape.hpp"

namespace firmtouch::spline {

/// Bounds the derivatives of D^2 / 2 over a part, of a curve the third, of a surface the fourth, by the
/// piece's s and t: fills fixed and turning.
/// Pre: the shape is the part's, its least_weight above 1 / 2.
void bound_bends(const Part& part, LeafShape& shape);
/// What is stored of a cell, a part of a surface: the most that its quarters' quarters need. Their bounds
/// are tighter than those of the whole: of one with weights about 4 times, else about 2.
constexpr uint32_t kFineParts = 16;
struct CellBends {
  float span_m = 0;  // no two points of the cell are farther apart
  float fixed[5] = {}, turning[5] = {};
};
/// Result: false where the weight may fall to half of its middle's.
bool begin_bends(const Piece& piece, const float* coefficients, const Part& cell, CellBends& bends);
bool add_bends(const Piece& piece, const float* coefficients, const Part& cell, uint32_t fine_part,
               CellBends& bends);

}  // namespace firmtouch::spline
