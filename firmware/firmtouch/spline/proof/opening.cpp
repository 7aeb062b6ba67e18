#include "firmtouch/spline/proof/opening.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/spline/proof/leaf_proof.hpp"
#include "firmtouch/spline/proof/leaf_shape.hpp"

namespace firmtouch::spline {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;
using math::Vec3;

constexpr uint32_t kMaxPieces = 65535;
constexpr float kUnit = 0x1p-24f;
// What `exact` promises less what closest_point() gives away leaves so much of the extent.
constexpr float kMaxLoss = 2.0f * kUnit, kMaxRationalLoss = 5.0f * kUnit;

bool is_between(float value, float low, float high) { return value >= low && value <= high; }
Vec3 vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

bool is_same(float a, float b) { return a <= b && a >= b; }
// With all bytes it is a number that has a square.
bool is_unit_size(float unit) { return is_between(unit, 0x1p-100f, 0x1p60f); }

bool is_inside(const Head& head, const float* at_m) {
  for (uint32_t k = 0; k < 3; ++k)
    if (!is_between(at_m[k], head.low_m[k], head.high_m[k])) return false;
  return true;
}

bool is_sound(const Box& box) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (!is_between(box.centre_m[k], -2.0f * kMaxCoordinate_m, 2.0f * kMaxCoordinate_m) ||
        !is_between(box.half_m[k], 0.0f, 4.0f * kMaxCoordinate_m))
      return false;
  }
  const Vec3 a = vec(box.axis[0]), b = vec(box.axis[1]);
  // No map with these rows lengthens a vector, the third, their product, included.
  const float across = dot(a, b), size = across < 0.0f ? -across : across;
  return dot(a, a) + size <= 1.0f - 0x1p-22f && dot(b, b) + size <= 1.0f - 0x1p-22f;
}

using Stage = query::StageOf<Proof>;

}  // namespace

const query::CheckStage Proof::kStages[5] = {
    Stage::of<&Proof::piece_count, &Proof::check_piece, &Proof::finish_pieces>(80),
    Stage::of<&Proof::point_count, &Proof::check_point>(2),
    Stage::of<&Proof::node_count, &Proof::check_node>(2),
    Stage::of<&Proof::cell_count, &Proof::check_cell, &Proof::finish_cells>(500),
    Stage::of<&Proof::leaf_count, &Proof::check_leaf>(600)};

Verdict Proof::take(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  const bool is_surface = head.is_surface != 0;
  if (head.piece_count == 0 || head.piece_count > (is_surface ? kMaxPatches : kMaxPieces) ||
      head.leaf_count < head.piece_count || head.leaf_count > kMaxLeaves ||
      (is_surface ? head.point_count > 4 * (kMaxLeaves + 1)
                  : head.point_count != head.leaf_count + 1))
    return reject(kRuleCounts);
  view.pieces_ = core::as_whole_array<Piece>(s.pieces);
  if (view.pieces_.size() != head.piece_count) return reject(kRuleSectionSize, 0);
  view.coefficients_ = core::as_whole_array<float>(s.coefficients);
  if (view.coefficients_.size() != head.coefficient_count) return reject(kRuleSectionSize, 1);
  view.head_ = &head;
  return is_surface ? take_surfaces(s, head) : take_curves(s, head);
}

Verdict Proof::take_curves(const Sections& s, const Head& head) {
  view.leaves_ = core::as_whole_array<uint16_t>(s.leaves);
  if (view.leaves_.size() != head.leaf_count) return reject(kRuleSectionSize, 2);
  if (s.nodes.size() != 0) return reject(kRuleSectionSize, 4);
  const uint32_t count = head.point_count, flat_size = count * sizeof(Point);
  view.points_ = core::as_array<Point>(s.points, count);
  if (view.points_.size() != count) return reject(kRuleSectionSize, 5);
  if (s.points.size() != flat_size) {
    view.heights_m_ =
        core::as_whole_array<float>({s.points.data() + flat_size, s.points.size() - flat_size});
    if (view.heights_m_.size() != count) return reject(kRuleSectionSize, 5);
  }
  view.curve_bends_ = core::as_whole_array<CurveBend>(s.bends);
  if (view.curve_bends_.size() != head.piece_count) return reject(kRuleSectionSize, 6);
  if (s.grids.size() != 0) return reject(kRuleSectionSize, 7);
  if (s.radii.size() != CurveLevels(head.leaf_count).node_count())
    return reject(kRuleSectionSize, 8);
  view.radii_ = s.radii.data();
  return kPassed;
}

Verdict Proof::take_surfaces(const Sections& s, const Head& head) {
  if (s.leaves.size() != 0) return reject(kRuleSectionSize, 2);
  view.boxes_ = core::as_whole_array<Box>(s.nodes);
  if (view.boxes_.size() != head.piece_count - 1) return reject(kRuleSectionSize, 4);
  view.corners_ = core::as_whole_array<Corner>(s.points);
  if (view.corners_.size() != head.point_count) return reject(kRuleSectionSize, 5);
  view.patch_bends_ = core::as_whole_array<PatchBend>(s.bends);
  if (view.patch_bends_.size() * sizeof(PatchBend) != s.bends.size())
    return reject(kRuleSectionSize, 6);
  view.grids_ = core::as_whole_array<Grid>(s.grids);
  if (view.grids_.size() != head.piece_count) return reject(kRuleSectionSize, 7);
  if (s.radii.size() != 3 * head.leaf_count - 2 * head.piece_count)
    return reject(kRuleSectionSize, 8);
  view.radii_ = s.radii.data();
  return kPassed;
}

Verdict Proof::check_head() const {
  const Head& head = view.head();
  if (head.is_surface > 1 || head.is_rational > 1) return reject(kRuleFlags);
  float longest_m = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    if (!(head.low_m[k] >= -kMaxCoordinate_m && head.low_m[k] <= head.high_m[k] &&
          head.high_m[k] <= kMaxCoordinate_m))
      return reject(kRuleHeadBox, k);
    const float side_m = head.high_m[k] - head.low_m[k];
    if (side_m > longest_m) longest_m = side_m;
  }
  if (!(head.extent_m >= kMinExtent_m && head.extent_m <= longest_m)) return reject(kRuleExtent);
  const float most = head.is_rational != 0 ? kMaxRationalLoss : kMaxLoss;
  if (!(head.loss_m >= 0.0f && head.loss_m <= head.extent_m * most)) return reject(kRuleLoss);
  if (head.worst_steps == 0) return reject(kRuleWorstSteps);
  const bool is_unit =
      head.is_surface != 0 ? is_same(head.radius_unit_m, 0.0f) : is_unit_size(head.radius_unit_m);
  return is_unit ? kPassed : reject(kRuleRadiusUnit);
}

uint32_t Proof::node_count() const {
  return view.is_surface() ? view.boxes_.size() : view.curve_radii().size();
}

uint32_t Proof::cell_count() const {
  return view.is_surface() ? view.patch_bends_.size() * kFineCells
                           : view.curve_bends_.size() * kFineSteps;
}

Verdict Proof::finish_pieces() {
  if (coefficients_used_ != view.coefficients_.size())
    return reject(kRuleCoefficients, view.pieces_.size());
  const bool is_used_up = leaves_used_ == view.leaf_count();
  if (!view.is_surface())
    return is_used_up ? kPassed : reject(kRuleCurveLeaves, view.pieces_.size());
  return is_used_up && corners_used_ == view.corners_.size() &&
                 cells_used_ == view.patch_bends_.size()
             ? kPassed
             : reject(kRuleGrid, view.pieces_.size());
}

Verdict Proof::check_piece(uint32_t i) {
  const Piece& piece = view.pieces_[i];
  const Head& head = *view.head_;
  const bool is_surface = head.is_surface != 0;
  if (piece.degree_u < 1 || piece.degree_u > kMaxDegree ||
      piece.degree_v < (is_surface ? 1u : 0u) || piece.degree_v > (is_surface ? kMaxDegree : 0u))
    return reject(kRuleDegree, i);
  if (piece.is_rational > head.is_rational ||
      piece.level_u > (is_surface ? kMaxHalvingsAcross : kMaxHalvings) ||
      piece.level_v > (is_surface ? kMaxHalvingsAcross : 0u))
    return reject(kRuleLevel, i);
  const uint32_t floats =
      (piece.degree_u + 1u) * (piece.degree_v + 1u) * (piece.is_rational != 0 ? 4u : 3u);
  if (piece.coefficients != coefficients_used_ ||
      floats > view.coefficients_.size() - coefficients_used_)
    return reject(kRuleCoefficients, i);
  for (uint32_t k = 0; k < floats; ++k)
    if (!is_between(view.coefficients_[coefficients_used_ + k], -64.0f * kMaxCoordinate_m,
                    64.0f * kMaxCoordinate_m))
      return reject(kRuleCoefficientRange, coefficients_used_ + k);
  coefficients_used_ += floats;
  for (uint32_t k = 0; k < 3; ++k)
    if (!is_between(piece.origin_m[k], -2.0f * kMaxCoordinate_m, 2.0f * kMaxCoordinate_m))
      return reject(kRulePieceRange, i);
  const float parameters[] = {piece.middle_u, piece.half_u, piece.middle_v, piece.half_v};
  for (const float parameter : parameters)
    if (!is_between(parameter, -1e30f, 1e30f)) return reject(kRulePieceRange, i);
  return is_surface ? check_grid(i) : check_curve(i);
}

// Its leaves, behind those of the piece before or one that is none; and of a flat model that it is.
Verdict Proof::check_curve(uint32_t i) {
  const Piece& piece = view.pieces_[i];
  const uint32_t first = view.curve_bends_[i].first_leaf, count = 1u << piece.level_u;
  if (i > 0 && first == leaves_used_ + 1 && first < view.leaf_count() &&
      view.leaves_[leaves_used_] == kNoLeaf)
    ++leaves_used_;
  if (first != leaves_used_ || count > view.leaf_count() - leaves_used_)
    return reject(kRuleCurveLeaves, i);
  for (uint32_t k = 0; k < count; ++k)
    if (view.leaves_[leaves_used_++] != i) return reject(kRuleCurveLeaves, i);
  if (!view.is_flat()) return kPassed;
  if (!is_same(piece.origin_m[2], view.pieces_[0].origin_m[2])) return reject(kRuleFlat, i);
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  for (uint32_t k = 0; k <= piece.degree_u; ++k)
    if (!is_same(view.coefficients_[piece.coefficients + k * stride + 2], 0.0f))
      return reject(kRuleFlat, i);
  return kPassed;
}

Verdict Proof::check_grid(uint32_t i) {
  const Piece& piece = view.pieces_[i];
  const Grid& grid = view.grids_[i];
  const uint32_t columns = 1u << piece.level_u, rows = 1u << piece.level_v;
  const uint32_t corners = (columns + 1) * (rows + 1);
  const Halvings cell = cell_levels(piece, grid);
  const uint32_t cells = 1u << (cell.u + cell.v);
  if (grid.cell_level > kMaxHalvingsAcross || grid.first_corner != corners_used_ ||
      grid.first_leaf != leaves_used_ || grid.first_cell != cells_used_ ||
      cells > view.patch_bends_.size() - cells_used_ ||
      corners > view.corners_.size() - corners_used_ ||
      columns * rows > view.leaf_count() - leaves_used_)
    return reject(kRuleGrid, i);
  corners_used_ += corners;
  leaves_used_ += columns * rows;
  cells_used_ += cells;
  const float units[] = {grid.radius_unit_m, grid.fixed_unit_m2, grid.turning_unit_m};
  for (const float unit : units)
    if (!is_unit_size(unit)) return reject(kRuleGridUnit, i);
  const bool is_power = (math::bits_of(grid.step_m) & 0x7FFFFFu) == 0;
  return is_power && is_between(grid.step_m, 0x1p-100f, 0x1p20f) ? kPassed
                                                                 : reject(kRuleGridUnit, i);
}

Verdict Proof::check_point(uint32_t i) {
  const math::Vec3 at_m = view.point_at(i);
  const float at[3] = {at_m.x, at_m.y, at_m.z};
  return is_inside(*view.head_, at) ? kPassed : reject(kRulePointOutside, i);
}

// Of a curve: what is no node has no radius.
Verdict Proof::check_node(uint32_t i) {
  if (view.is_surface()) return is_sound(view.boxes_[i]) ? kPassed : reject(kRuleNode, i);
  const bool is_there = CurveLevels(view.leaf_count()).below(i + 1).first < view.leaf_count();
  return is_there || view.curve_radii()[i] == 0 ? kPassed : reject(kRuleNode, i);
}

Verdict Proof::check_cell(uint32_t i) {
  if (!view.is_surface()) return check_bend(view, i / kFineSteps, i % kFineSteps, curve_bends_);
  const Grid& grid = view.grids_[piece_];
  const Halvings cell = cell_levels(view.pieces_[piece_], grid);
  const uint32_t of = i / kFineCells;
  const Verdict found = spline::check_cell(view, piece_, of, i % kFineCells, bends_);
  const bool is_last = (i + 1) % kFineCells == 0;
  if (is_last && of + 1 - grid.first_cell == 1u << (cell.u + cell.v)) ++piece_;
  return found;
}

Verdict Proof::finish_cells() {
  piece_ = 0;
  return kPassed;
}

Verdict Proof::check_leaf(uint32_t i) {
  const bool is_surface = view.is_surface();
  View::LeafIndex at_leaf{};
  if (is_surface) {
    at_leaf.piece = piece_;
    at_leaf.index_u = in_piece_ % (1u << view.pieces_[piece_].level_u);
    at_leaf.index_v = in_piece_ >> view.pieces_[piece_].level_u;
  } else {
    if (!view.is_leaf(i)) return kPassed;
    at_leaf = view.index_of(i);
  }
  const Piece& piece = view.pieces_[at_leaf.piece];
  LeafShape shape;
  derive(piece, view.coefficients_.data() + piece.coefficients,
         region_of(piece, at_leaf.index_u, at_leaf.index_v), shape);
  if (!(shape.min_weight > 0.0f)) return reject(kRuleWeight, i);
  const Head& head = *view.head_;
  if (!(shape.loss_m <= head.loss_m)) return reject(kRuleLeafLoss, i);
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 axis{k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
    const auto is_within = [&](By by) {
      const Extent extent = extent_along(shape, {}, axis, by);
      return extent.low >= head.low_m[k] && extent.high <= head.high_m[k];
    };
    if (!is_within(By::kBall) && !is_within(By::kCoefficients)) return reject(kRuleLeafOutside, i);
  }
  if (!is_surface) return check_capsules(view, i, shape);
  if (++in_piece_ == 1u << (piece.level_u + piece.level_v)) {
    in_piece_ = 0;
    ++piece_;
  }
  return check_patch(view, i, at_leaf, shape);
}

}  // namespace firmtouch::spline

template class firmtouch::query::Opening<firmtouch::spline::Proof>;
