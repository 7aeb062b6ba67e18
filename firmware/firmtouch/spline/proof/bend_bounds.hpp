#pragma once
#include "firmtouch/spline/proof/leaf_shape.hpp"

namespace firmtouch::spline {

/// Bounds the fourth derivatives of D^2 / 2 over a part of a surface, by the piece's s and t, those
/// of even powers from below: fills fixed and turning.
/// Pre: the shape is the part's, its min_weight above 1 / 2.
void bound_bends(const Region& region, LeafShape& shape);
/// What is stored of a cell, a part of a surface: the most that its parts, so many on a side, need.
/// Their bounds are tighter than those of the whole.
constexpr uint32_t kFineSide = 4, kFineCells = kFineSide * kFineSide;
struct CellBends {
  float span_m = 0;  // no two points of the cell are farther apart
  float fixed[5] = {}, turning[5] = {};
};
/// Result: false where the weight may fall to half of its middle's.
bool begin_bends(const Piece& piece, const float* coefficients, const Region& cell,
                 CellBends& bends);
bool add_bends(const Piece& piece, const float* coefficients, const Region& cell,
               uint32_t fine_step, CellBends& bends);

/// What is stored of a curve's piece: how far the fourth derivative of D^2 / 2 may be below 0 at
/// most on one of its sixteenths.
constexpr uint32_t kFineSteps = 16;
constexpr float kMaxBend = 0x1p90f;  // with the square of any length of a model it is a float32
struct CurveBends {
  float span_m = 0;                       // no two points of the piece are farther apart
  float lowest = 0;                       // of the terms without the query
  float turning = 0;                      // of those with it
  float speed = 0, swing = 0, twist = 0;  // the sizes of the curve's own first three derivatives
  float loss_m = 0;                       // of a point that evaluation.hpp computes
  /// All but the first leaf.
  CurveBend stored() const;
};
/// Result: false where the weight may fall to half of its middle's.
bool add_bends(const Piece& piece, const float* coefficients, uint32_t fine_step,
               CurveBends& bends);

}  // namespace firmtouch::spline
