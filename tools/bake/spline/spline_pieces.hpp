#pragma once
#include <vector>

#include "firmtouch/spline/layout.hpp"
#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/proof/leaf_shape.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// A Bezier piece as the firmware stores it: float32 powers about its middle.
struct StoredPiece {
  spline::Piece piece{};  // `coefficients` and the levels are set when all are put together
  std::vector<float> coefficients;
  double deviation_m = 0;  // of any point of it from the piece that it was made of, at most
};

/// Curves have degree_v 0 and one row of points.
StoredPiece store_piece(const BezierPatch& patch, bool is_surface);
BezierPatch as_patch(const BezierCurve& curve);

/// The same patch from its other side: u runs the other way, from u1 to u0.
BezierPatch turned_over(const BezierPatch& patch);

/// The two halves of a patch across its middle, along u or v.
std::vector<BezierPatch> halves_of(const BezierPatch& patch, bool along_v);

/// What the firmware derives of a part of a piece, `level_u` and `level_v` halvings deep.
spline::LeafShape shape_of(const StoredPiece& stored, uint32_t level_u, uint32_t index_u,
                           uint32_t level_v, uint32_t index_v);

/// The same of a cell's bends. Result: false where the weight may fall to half of its middle's.
bool bound_cell(const StoredPiece& stored, const spline::Halvings& levels, uint32_t index_u,
                uint32_t index_v, spline::CellBends& bends);

}  // namespace firmtouch::tools
