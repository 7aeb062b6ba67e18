#include "firmtouch/spline/view.hpp"

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

}  // namespace firmtouch::spline
