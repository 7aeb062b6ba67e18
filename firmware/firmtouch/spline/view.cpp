#include "firmtouch/spline/view.hpp"

#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::spline {

View::LeafIndex View::index_of(uint32_t leaf) const {
  if (!is_surface()) {
    const uint32_t piece = leaves_[leaf];
    return {piece, leaf - curve_bends_[piece].first_leaf, 0};
  }
  uint32_t first = 0, last = grids_.size() - 1;  // the last piece that begins no later
  while (first < last) {
    const uint32_t middle = (first + last + 1) / 2;
    if (grids_[middle].first_leaf <= leaf)
      first = middle;
    else
      last = middle - 1;
  }
  const uint32_t in_piece = leaf - grids_[first].first_leaf, level_u = pieces_[first].level_u;
  return {first, in_piece & ((1u << level_u) - 1u), in_piece >> level_u};
}

View::Bounds View::bounds_of(uint32_t leaf) const {
  if (!is_surface()) {
    const CurveBend& bend = curve_bends_[leaves_[leaf]];
    return {{bend.fixed_m2}, {bend.turning_m}};
  }
  const LeafIndex at_leaf = index_of(leaf);
  const Grid& grid = grids_[at_leaf.piece];
  const PatchBend& bend =
      patch_bends_[cell_of(pieces_[at_leaf.piece], grid, at_leaf.index_u, at_leaf.index_v)];
  Bounds bounds;
  for (uint32_t k = 0; k < 5; ++k) {
    bounds.fixed_m2[k] = in_units(grid.fixed_unit_m2, bend.fixed[k]);
    bounds.turning_m[k] = in_units(grid.turning_unit_m, bend.turning[k]);
  }
  return bounds;
}

}  // namespace firmtouch::spline
