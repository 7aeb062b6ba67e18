#pragma once
// What open() proves of a leaf beside its head's promises.
#include "firmtouch/core/status.hpp"
#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// All capsules that hold it (R623).
/// Pre: the model is proven up to its leaves; `shape` is leaf i's.
core::Verdict check_capsules(const View& model, uint32_t i, const LeafShape& shape);
/// Of a curve's piece one of kFineParts after the other, and with the last of them its bend (R619,
/// R620).
core::Verdict check_bend(const View& model, uint32_t piece, uint32_t fine_step, CurveBends& needed);
/// Of a surface's leaf the quads with radii, and the boxes, that hold it (R623).
core::Verdict check_patch(const View& model, uint32_t i, const View::LeafIndex& at_leaf,
                          const LeafShape& shape);

/// Of a surface's cell one of kFineCells after the other, and with the last of them its bends
/// (R619, R620). `needed` is carried from each to the next.
/// Pre: the model is proven up to its cells; the cell is the piece's.
core::Verdict check_cell(const View& model, uint32_t piece_index, uint32_t cell, uint32_t fine_step,
                         CellBends& needed);

}  // namespace firmtouch::spline
