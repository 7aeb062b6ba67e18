#pragma once
// What open() proves of a leaf beside its head's promises.
#include "firmtouch/core/status.hpp"
#include "firmtouch/spline/leaf_shape.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Its bends, which are derived here, and all capsules that hold it (R620, R623).
/// Pre: the model is proven up to its leaves; `shape` is leaf i's.
core::Verdict check_capsules(const View& model, uint32_t i, LeafShape& shape);
/// The same of a surface: the bends of its cell, the parallelograms with radii and the boxes that hold it.
core::Verdict check_patch(const View& model, uint32_t i, const View::Place& place,
                          const LeafShape& shape);

}  // namespace firmtouch::spline
