#pragma once
#include "firmtouch/spline/surface/patch_grid.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline_test {

/// What is stored of a leaf: bounds of the fourth derivatives ssss, ssst, sstt, sttt, tttt (of a
/// curve: of the first).
struct Bounds {
  float fixed_m2[5], turning_m[5];
};
inline Bounds bounds_of(const spline::View& model, uint32_t leaf) {
  const spline::View::LeafIndex at = model.index_of(leaf);
  if (!model.is_surface()) {
    const spline::CurveBend& bend = model.curve_bends()[at.piece];
    return {{bend.fixed_m2}, {bend.turning_m}};
  }
  const spline::Grid& grid = model.grids()[at.piece];
  const spline::PatchBend& bend =
      model.patch_bends()[cell_of(model.pieces()[at.piece], grid, at.index_u, at.index_v)];
  Bounds bounds;
  for (uint32_t k = 0; k < 5; ++k) {
    bounds.fixed_m2[k] = spline::in_units(grid.fixed_unit_m2, bend.fixed[k]);
    bounds.turning_m[k] = spline::in_units(grid.turning_unit_m, bend.turning[k]);
  }
  return bounds;
}

}  // namespace firmtouch::spline_test
