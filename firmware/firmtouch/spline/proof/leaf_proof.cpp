#include "firmtouch/spline/proof/leaf_proof.hpp"

#include "firmtouch/spline/proof/bend_bounds.hpp"
#include "firmtouch/spline/proof/patch_radius.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"

namespace firmtouch::spline {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

bool bends_hold(const PatchBend& bend, const Grid& grid, const CellBends& needed) {
  for (uint32_t k = 0; k < 5; ++k)
    if (!(in_units(grid.fixed_unit_m2, bend.fixed[k]) >= needed.fixed[k] &&
          in_units(grid.turning_unit_m, bend.turning[k]) >= needed.turning[k]))
      return false;
  return true;
}

}  // namespace

Verdict check_capsules(const View& model, uint32_t i, const LeafShape& shape) {
  const CurveLevels levels(model.leaf_count());
  const math::Vec3 a = model.point_at(i), b = model.point_at(i + 1);
  const auto stored_m = [&](uint32_t node) {
    return in_units(model.head().radius_unit_m, model.curve_radii()[node - 1]);
  };
  uint32_t node = levels.first_node() + i;
  const float leaf_m = stored_m(node);
  if (!(radius_for(shape, a, b) <= leaf_m)) return reject(kRuleEnclosure, i);
  for (node >>= 1; node != 0; node >>= 1) {
    const CurveLevels::Leaves under = levels.below(node);
    const float needed_m =
        under.end - under.first == 1
            ? leaf_m
            : radius_above(leaf_m, a, b, model.point_at(under.first), model.point_at(under.end));
    if (!(needed_m <= stored_m(node))) return reject(kRuleEnclosure, i);
  }
  return kPassed;
}

Verdict check_bend(const View& model, uint32_t piece_index, uint32_t fine_step,
                   CurveBends& needed) {
  const Piece& piece = model.pieces()[piece_index];
  if (fine_step == 0) needed = {};
  if (!add_bends(piece, model.coefficients().data() + piece.coefficients, fine_step, needed))
    return reject(kRuleWeight, piece_index);
  if (fine_step + 1 < kFineSteps) return kPassed;
  const CurveBend &stored = model.curve_bends()[piece_index], least = needed.stored();
  const auto holds = [](float value, float at_least) {
    return value >= at_least && value <= kMaxBend;
  };
  return holds(stored.fixed_m2, least.fixed_m2) && holds(stored.turning_m, least.turning_m) &&
                 holds(stored.noise_m2, least.noise_m2) &&
                 holds(stored.noise_turning_m, least.noise_turning_m)
             ? kPassed
             : reject(kRuleBends, piece_index);
}

Verdict check_cell(const View& model, uint32_t piece_index, uint32_t cell, uint32_t fine_step,
                   CellBends& needed) {
  const Piece& piece = model.pieces()[piece_index];
  const Grid& grid = model.grids()[piece_index];
  const float* const coefficients = model.coefficients().data() + piece.coefficients;
  const Halvings levels = cell_levels(piece, grid);
  const uint32_t in_piece = cell - grid.first_cell;
  const Region region = region_of(levels, in_piece & ((1u << levels.u) - 1u), in_piece >> levels.u);
  if (fine_step == 0 && !begin_bends(piece, coefficients, region, needed))
    return reject(kRuleWeight, cell);
  if (!add_bends(piece, coefficients, region, fine_step, needed)) return reject(kRuleWeight, cell);
  const bool is_last = fine_step + 1 == kFineCells;
  if (is_last && !bends_hold(model.patch_bends()[cell], grid, needed))
    return reject(kRuleBends, cell);
  return kPassed;
}

Verdict check_patch(const View& model, uint32_t i, const View::LeafIndex& at_leaf,
                    const LeafShape& shape) {
  const Piece& piece = model.pieces()[at_leaf.piece];
  const Grid& grid = model.grids()[at_leaf.piece];
  Patch patch{at_leaf.piece, 0u + piece.level_u + piece.level_v, at_leaf.index_u, at_leaf.index_v};
  const auto quad = [&] { return stored_quad(piece, grid, model.corners().data(), patch); };
  const auto stored_m = [&] {
    return in_units(grid.radius_unit_m,
                    model.radii()[radius_of(grid, patch, halvings_of(piece, patch.depth))]);
  };
  const Patch leaf = patch;
  const LeafPoints points(shape);
  if (!(radius_for(points, quad(), {}) <= stored_m())) return reject(kRuleEnclosure, i);
  while (patch.depth != 0) {
    patch = parent_of(piece, patch);
    const uint32_t overlap =
        model.overlaps()[overlap_of(grid, patch, halvings_of(piece, patch.depth))];
    const RegionOfQuad half = half_of(piece, patch, leaf, overlap);
    if (!(radius_for(points, quad(), own_of(piece, patch, leaf), half) <= stored_m()))
      return reject(kRuleEnclosure, i);
  }
  for (uint32_t at = model.pieces().size() - 1 + at_leaf.piece; at != 0;) {
    at = parent_of(at);
    if (!leaf_fits(shape, model.boxes()[at])) return reject(kRuleEnclosure, i);
  }
  return kPassed;
}

}  // namespace firmtouch::spline
