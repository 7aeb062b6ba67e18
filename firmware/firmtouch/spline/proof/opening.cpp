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

constexpr uint32_t kLeafElements = 64;
constexpr uint32_t kMaxPieces = 65535;
constexpr float kUnit = 0x1p-24f;
// What `exact` promises less what closest_point() gives away leaves so much of the extent.
constexpr float kMaxLoss = 2.0f * kUnit, kMaxRationalLoss = 5.0f * kUnit;

bool is_between(float value, float low, float high) { return value >= low && value <= high; }
Vec3 vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

bool is_same(float a, float b) { return a <= b && a >= b; }
// With all bytes it is a number that has a square.
bool is_unit_size(float unit) { return is_between(unit, 0x1p-100f, 0x1p60f); }

Verdict check_head(const Head& head) {
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

}  // namespace

Opening::Opening(const Sections& sections) { open_head(sections); }

void Opening::fail(uint16_t rule, uint32_t element) {
  verdict_ = reject(rule, element);
  stage_ = Stage::kDone;
}

void Opening::open_head(const Sections& sections) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(sections.head);
  if (heads.size() != 1) return fail(kRuleHeadSize, 0);
  const Head& head = heads[0];
  const bool is_surface = head.is_surface != 0;
  if (head.piece_count == 0 || head.piece_count > (is_surface ? kMaxPatches : kMaxPieces) ||
      head.leaf_count < head.piece_count || head.leaf_count > kMaxLeaves ||
      (is_surface ? head.point_count > 4 * (kMaxLeaves + 1)
                  : head.point_count != head.leaf_count + 1))
    return fail(kRuleCounts, 0);
  verdict_ = check_head(head);
  if (verdict_.ok()) verdict_ = take_sections(sections, head);
  if (!verdict_.ok()) return;
  view_.head_ = &head;
  stage_ = Stage::kPieces;
}

Verdict Opening::take_sections(const Sections& s, const Head& head) {
  view_.pieces_ = core::as_whole_array<Piece>(s.pieces);
  if (view_.pieces_.size() != head.piece_count) return reject(kRuleSectionSize, 0);
  view_.coefficients_ = core::as_whole_array<float>(s.coefficients);
  if (view_.coefficients_.size() != head.coefficient_count) return reject(kRuleSectionSize, 1);
  return head.is_surface != 0 ? take_surfaces(s, head) : take_curves(s, head);
}

Verdict Opening::take_curves(const Sections& s, const Head& head) {
  view_.leaves_ = core::as_whole_array<uint16_t>(s.leaves);
  if (view_.leaves_.size() != head.leaf_count) return reject(kRuleSectionSize, 2);
  if (s.nodes.size() != 0) return reject(kRuleSectionSize, 4);
  const uint32_t count = head.point_count, flat_size = count * sizeof(Point);
  view_.points_ = core::as_array<Point>(s.points, count);
  if (view_.points_.size() != count) return reject(kRuleSectionSize, 5);
  if (s.points.size() != flat_size) {
    view_.heights_m_ =
        core::as_whole_array<float>({s.points.data() + flat_size, s.points.size() - flat_size});
    if (view_.heights_m_.size() != count) return reject(kRuleSectionSize, 5);
  }
  view_.curve_bends_ = core::as_whole_array<CurveBend>(s.bends);
  if (view_.curve_bends_.size() != head.piece_count) return reject(kRuleSectionSize, 6);
  if (s.grids.size() != 0) return reject(kRuleSectionSize, 7);
  if (s.radii.size() != CurveLevels(head.leaf_count).node_count())
    return reject(kRuleSectionSize, 8);
  view_.radii_ = s.radii.data();
  return kPassed;
}

Verdict Opening::take_surfaces(const Sections& s, const Head& head) {
  if (s.leaves.size() != 0) return reject(kRuleSectionSize, 2);
  view_.boxes_ = core::as_whole_array<Box>(s.nodes);
  if (view_.boxes_.size() != head.piece_count - 1) return reject(kRuleSectionSize, 4);
  view_.corners_ = core::as_whole_array<Corner>(s.points);
  if (view_.corners_.size() != head.point_count) return reject(kRuleSectionSize, 5);
  view_.patch_bends_ = core::as_whole_array<PatchBend>(s.bends);
  if (view_.patch_bends_.size() * sizeof(PatchBend) != s.bends.size())
    return reject(kRuleSectionSize, 6);
  view_.grids_ = core::as_whole_array<Grid>(s.grids);
  if (view_.grids_.size() != head.piece_count) return reject(kRuleSectionSize, 7);
  if (s.radii.size() != 3 * head.leaf_count - 2 * head.piece_count)
    return reject(kRuleSectionSize, 8);
  view_.radii_ = s.radii.data();
  return kPassed;
}

void Opening::work(uint32_t elements) {
  for (uint32_t used = 0; used < elements && stage_ != Stage::kDone;) {
    used += stage_ == Stage::kLeaves || stage_ == Stage::kCells ? kLeafElements : 1;
    if (next_ < this->elements()) {
      const Verdict found = check(next_);
      if (!found.ok()) return fail(found.rule, found.element);
      ++next_;
    }
    if (next_ == this->elements()) next_stage();
  }
}

uint32_t Opening::elements() const {
  switch (stage_) {
    case Stage::kPieces:
      return view_.pieces_.size();
    case Stage::kPoints:
      return view_.points_.size();
    case Stage::kNodes:
      return view_.is_surface() ? view_.boxes_.size() : view_.curve_radii().size();
    case Stage::kCells:
      return view_.is_surface() ? view_.patch_bends_.size() * kFineCells
                                : view_.curve_bends_.size() * kFineParts;
    default:
      return view_.leaf_count();
  }
}

void Opening::next_stage() {
  next_ = 0;
  if (stage_ == Stage::kCells) piece_ = 0;
  if (stage_ == Stage::kPieces && coefficients_used_ != view_.coefficients_.size())
    return fail(kRuleCoefficients, view_.pieces_.size());
  if (stage_ == Stage::kPieces && view_.is_surface() &&
      (corners_used_ != view_.corners_.size() || leaves_used_ != view_.leaf_count() ||
       cells_used_ != view_.patch_bends_.size()))
    return fail(kRuleGrid, view_.pieces_.size());
  if (stage_ == Stage::kPieces && !view_.is_surface() && leaves_used_ != view_.leaf_count())
    return fail(kRuleCurveLeaves, view_.pieces_.size());
  stage_ = static_cast<Stage>(static_cast<uint8_t>(stage_) + 1);
}

Verdict Opening::check(uint32_t i) {
  switch (stage_) {
    case Stage::kPieces:
      return check_piece(i);
    case Stage::kPoints:
      return check_point(i);
    case Stage::kNodes:
      return check_node(i);
    case Stage::kCells:
      return check_cell(i);
    case Stage::kLeaves:
      return check_leaf(i);
    case Stage::kDone:
      break;
  }
  return kPassed;
}

Verdict Opening::check_piece(uint32_t i) {
  const Piece& piece = view_.pieces_[i];
  const Head& head = *view_.head_;
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
      floats > view_.coefficients_.size() - coefficients_used_)
    return reject(kRuleCoefficients, i);
  for (uint32_t k = 0; k < floats; ++k)
    if (!is_between(view_.coefficients_[coefficients_used_ + k], -64.0f * kMaxCoordinate_m,
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
Verdict Opening::check_curve(uint32_t i) {
  const Piece& piece = view_.pieces_[i];
  const uint32_t first = view_.curve_bends_[i].first_leaf, count = 1u << piece.level_u;
  if (i > 0 && first == leaves_used_ + 1 && first < view_.leaf_count() &&
      view_.leaves_[leaves_used_] == kNoLeaf)
    ++leaves_used_;
  if (first != leaves_used_ || count > view_.leaf_count() - leaves_used_)
    return reject(kRuleCurveLeaves, i);
  for (uint32_t k = 0; k < count; ++k)
    if (view_.leaves_[leaves_used_++] != i) return reject(kRuleCurveLeaves, i);
  if (!view_.is_flat()) return kPassed;
  if (!is_same(piece.origin_m[2], view_.pieces_[0].origin_m[2])) return reject(kRuleFlat, i);
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  for (uint32_t k = 0; k <= piece.degree_u; ++k)
    if (!is_same(view_.coefficients_[piece.coefficients + k * stride + 2], 0.0f))
      return reject(kRuleFlat, i);
  return kPassed;
}

Verdict Opening::check_grid(uint32_t i) {
  const Piece& piece = view_.pieces_[i];
  const Grid& grid = view_.grids_[i];
  const uint32_t columns = 1u << piece.level_u, rows = 1u << piece.level_v;
  const uint32_t corners = (columns + 1) * (rows + 1);
  const Halvings cell = cell_levels(piece, grid);
  const uint32_t cells = 1u << (cell.u + cell.v);
  if (grid.cell_level > kMaxHalvingsAcross || grid.first_corner != corners_used_ ||
      grid.first_leaf != leaves_used_ || grid.first_cell != cells_used_ ||
      cells > view_.patch_bends_.size() - cells_used_ ||
      corners > view_.corners_.size() - corners_used_ ||
      columns * rows > view_.leaf_count() - leaves_used_)
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

Verdict Opening::check_point(uint32_t i) {
  const math::Vec3 at_m = view_.point_at(i);
  const float at[3] = {at_m.x, at_m.y, at_m.z};
  return is_inside(*view_.head_, at) ? kPassed : reject(kRulePointOutside, i);
}

// Of a curve: what is no node has no radius.
Verdict Opening::check_node(uint32_t i) const {
  if (view_.is_surface()) return is_sound(view_.boxes_[i]) ? kPassed : reject(kRuleNode, i);
  const bool is_there = CurveLevels(view_.leaf_count()).below(i + 1).first < view_.leaf_count();
  return is_there || view_.curve_radii()[i] == 0 ? kPassed : reject(kRuleNode, i);
}

Verdict Opening::check_cell(uint32_t i) {
  if (!view_.is_surface()) return check_bend(view_, i / kFineParts, i % kFineParts, curve_bends_);
  const Grid& grid = view_.grids_[piece_];
  const Halvings cell = cell_levels(view_.pieces_[piece_], grid);
  const uint32_t of = i / kFineCells;
  const Verdict found = spline::check_cell(view_, piece_, of, i % kFineCells, bends_);
  const bool is_last = (i + 1) % kFineCells == 0;
  if (is_last && of + 1 - grid.first_cell == 1u << (cell.u + cell.v)) ++piece_;
  return found;
}

Verdict Opening::check_leaf(uint32_t i) {
  const bool is_surface = view_.is_surface();
  View::Place place{};
  if (is_surface) {
    place.piece = piece_;
    place.index_u = in_piece_ % (1u << view_.pieces_[piece_].level_u);
    place.index_v = in_piece_ >> view_.pieces_[piece_].level_u;
  } else {
    if (!view_.is_leaf(i)) return kPassed;
    place = view_.place_of(i);
  }
  const Piece& piece = view_.pieces_[place.piece];
  LeafShape shape;
  derive(piece, view_.coefficients_.data() + piece.coefficients,
         part_of(piece, place.index_u, place.index_v), shape);
  if (!(shape.min_weight > 0.0f)) return reject(kRuleWeight, i);
  const Head& head = *view_.head_;
  if (!(shape.loss_m <= head.loss_m)) return reject(kRuleLeafLoss, i);
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 axis{k == 0 ? 1.0f : 0.0f, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
    const Extent extent = extent_along(shape, {}, axis);
    if (!(extent.low >= head.low_m[k] && extent.high <= head.high_m[k]))
      return reject(kRuleLeafOutside, i);
  }
  if (!is_surface) return check_capsules(view_, i, shape);
  if (++in_piece_ == 1u << (piece.level_u + piece.level_v)) {
    in_piece_ = 0;
    ++piece_;
  }
  return check_patch(view_, i, place, shape);
}

core::Verdict open(const Sections& sections, View& view) {
  Opening opening(sections);
  while (!opening.done()) opening.work(1u << 20);
  view = opening.view();
  return opening.verdict();
}

}  // namespace firmtouch::spline
