#pragma once
// How the parts of surfaces are numbered, and what closes them, for .cpp files of this module only.
#include "firmtouch/spline/surface/expansion.hpp"
#include "firmtouch/spline/surface/frontier.hpp"
#include "firmtouch/spline/surface/patch_grid.hpp"
#include "firmtouch/spline/surface/patch_node.hpp"
#include "firmtouch/spline/surface/point.hpp"

namespace firmtouch::spline {

class SurfaceNodes {
 public:
  using Range = Rectangle;

  SurfaceNodes(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        coefficients_(model.coefficients().data()),
        grids_(model.grids().data()),
        bends_(model.patch_bends().data()),
        piece_count_(model.pieces().size()),
        loss_m_(model.head().loss_m),
        p_m_(p_m) {}

  /// At most so many inner nodes are above a piece.
  uint32_t levels_above() const { return digits_of(2 * piece_count_); }
  uint32_t root() const { return upper(0); }
  uint32_t upper(uint32_t i) const {
    return i >= piece_count_ - 1 ? (i - (piece_count_ - 1)) << 16 | kWholePiece : kUpper + i;
  }
  uint32_t upper_of(uint32_t node) const {
    return node >= kUpper ? node - kUpper : (node >> 16) + piece_count_ - 1;
  }

  /// The leaf of a hint, from where it was left: none for a hint that is none.
  bool resume(const CurveHint& hint, uint32_t& node, Range& range) const {
    const uint32_t foot = hint.foot;
    const uint32_t piece = foot >> 16, u = (foot >> 8) & 255u, v = foot & 255u;
    if (piece >= piece_count_) return false;
    const Piece& of = pieces_[piece];
    node = node_of_leaf(of, piece, u >> (8u - of.level_u), v >> (8u - of.level_v));
    range = range_of(apart(of, node), 0.0f, 0.0f);
    range.start[0] = start_at(u << 8 | hint.fine[0]);
    range.start[1] = start_at(v << 8 | hint.fine[1]);
    return true;
  }
  /// Where the next query, after the same motion once more, will have its foot.
  void leave(const Best& best, math::Vec3 motion_m, CurveHint& hint) const {
    const float(&h)[3] = best.bend;
    const float determinant = h[0] * h[2] - h[1] * h[1];
    float to[2] = {best.s, best.t};
    if (h[0] > 0.0f && determinant > 0x1p-6f * (h[0] * h[2])) {
      const float u = dot(best.along[0], motion_m), v = dot(best.along[1], motion_m);
      const float step[2] = {(h[2] * u - h[1] * v) / determinant,
                             (h[0] * v - h[1] * u) / determinant};
      for (uint32_t k = 0; k < 2; ++k)
        if (step[k] > -kMaxStep && step[k] < kMaxStep) to[k] += step[k];
    }
    const uint32_t u = coded(0.5f * to[0] + 0.5f, 65535), v = coded(0.5f * to[1] + 0.5f, 65535);
    hint.foot = (best.node & 0xFFFF0000u) | (u & 0xFF00u) | v >> 8;
    hint.fine[0] = static_cast<uint8_t>(u & 255u);
    hint.fine[1] = static_cast<uint8_t>(v & 255u);
  }

  /// Whether the last expansion is the one that closed this leaf: no other one says what is about
  /// it.
  bool was_closed_last(uint32_t leaf) const { return closed_ == leaf; }
  /// The largest part about a leaf, just closed, that the same expansion closes: at most its cell.
  uint32_t closed_around(uint32_t leaf, const Best& best) {
    const Piece& piece = pieces_[leaf >> 16];
    const Halvings cell = cell_levels(piece, grids_[leaf >> 16]);
    PatchNode patch = apart(piece, leaf);
    uint32_t node = leaf;
    while (widen(patch, cell) && closes(patch, best)) node = node_of(leaf >> 16, patch);
    return node;
  }

  /// Whether the expansion that closed the last leaf closes this part of its cell as well: not
  /// tested for large ones.
  bool is_closed(uint32_t node, const Best& best) {
    if (closed_ == kNone || (node ^ closed_) >> 16 != 0) return false;
    const PatchNode patch = apart(pieces_[node >> 16], node);
    return patch.left_u + patch.left_v <= kTried && is_closed_in_cell(node, patch, best);
  }
  bool is_closed_in_cell(uint32_t node, const Best& best) {
    if (closed_ == kNone || (node ^ closed_) >> 16 != 0) return false;
    return is_closed_in_cell(node, apart(pieces_[node >> 16], node), best);
  }
  /// How far what was closed last is at least.
  float reported_m() const {
    return upper2_ > 0.0f ? math::square_root(upper2_) * (1.0f - 0x1p-21f) : 0.0f;
  }

  /// Whether a word of a hint is a node.
  bool is_node(uint32_t node) const {
    if (node >= kUpper) return node - kUpper < piece_count_ - 1;
    if (node >> 16 >= piece_count_ || (node & 0xC000u) != 0) return false;
    if ((node & 0x3F80u) == 0 || (node & 127u) == 0) return false;
    const PatchNode patch = apart(pieces_[node >> 16], node);
    if ((patch.left_u | patch.left_v) >> 31 != 0) return false;  // below a leaf
    // In the order of halvings: the axis with more of them left first, then u and v in turn.
    const uint32_t ahead = patch.left_v - patch.left_u;
    return ahead <= 1 || (ahead >> 31 != 0 ? patch.made_v : patch.made_u) == 0;
  }
  /// Whether a node is a leaf's own, or above it.
  bool holds(uint32_t node, uint32_t leaf) const {
    if (node >= kUpper) {
      const uint32_t top = node - kUpper;
      uint32_t i = upper_of((leaf & 0xFFFF0000u) | kWholePiece);
      while (i > top) i = parent_of(i);
      return i == top;
    }
    if ((node ^ leaf) >> 16 != 0) return false;
    const uint32_t u = (node >> 7) & 127u, v = node & 127u;
    const uint32_t of_u = (leaf >> 7) & 127u, of_v = leaf & 127u;
    const uint32_t made_u = digits_of(u), made_v = digits_of(v);
    const uint32_t more_u = digits_of(of_u) - made_u, more_v = digits_of(of_v) - made_v;
    return of_u >> more_u == u && of_v >> more_v == v;
  }

  Outcome solve(uint32_t node, Range& range, float lower_m, query::Work& work, BandedBest& best,
                Half<Range> (&halves)[2]) {
    if (best.limit_m <= 0.0f) {
      upper2_ = 0.0f;
      return Outcome::kClosed;
    }
    const Piece& piece = pieces_[node >> 16];
    closed_ = kNone;
    SurfaceBends bends;
    stored_bends(piece, node, bends);
    const math::Vec3 q_m = p_m_ - vec3_at(piece.origin_m);
    float at[2] = {range.start[0], range.start[1]};
    Quadratic *f = expansions_, *base = expansions_ + 1;
    base->distance2 = FLT_MAX;
    for (uint32_t turn = 0; turn < kMaxTurns; ++turn) {
      if (!work.visit()) {
        range.start[0] = at[0];
        range.start[1] = at[1];
        return Outcome::kStopped;
      }
      work.charge(kEvaluationWork);
      ++best.evaluations;
      expand(node, piece, bends, q_m, at, best, *f);
      if (!(f->distance2 < base->distance2)) {  // too far along the way: a quarter of it
        for (uint32_t k = 0; k < 2; ++k) at[k] = base->at[k] + 0.25f * (at[k] - base->at[k]);
        continue;
      }
      Quadratic* const before = base;
      base = f;
      f = before;
      const float gain = base->next(range, at);
      const float moved = (at[0] - base->at[0]) * (at[0] - base->at[0]) +
                          (at[1] - base->at[1]) * (at[1] - base->at[1]);
      const bool is_best = !(base->distance2 > best.distance2_m2);
      const bool has_arrived = !(moved > 0x1p-40f && gain > kRounding * base->distance2);
      // What Newton's step would gain is needed: no proof can hold yet.
      if (!has_arrived && (is_best || !best.seems_beyond(base->distance2 - 2.0f * gain))) continue;
      upper2_ = base->least2(range, best.enough2());
      if (!best.is_beyond(upper2_)) break;
      closed_by_ = base;
      closed_ = node;
      return Outcome::kClosed;
    }
    return split(range, *base, lower_m, halves);
  }

  bool closes(const PatchNode& patch, const Best& best) {
    upper2_ = closed_by_->least2(range_of(patch, 0.0f, 0.0f), best.enough2());
    return best.is_beyond(upper2_);
  }

  /// A part, to be begun at x and y of its own, from -1 to 1. Its u and v count from 1 before the
  /// piece.
  static Range range_of(const PatchNode& patch, float x, float y) {
    const float half_u = math::float_of((127u - patch.made_u) << 23);
    const float half_v = math::float_of((127u - patch.made_v) << 23);
    const float u = static_cast<float>(2 * patch.u + 1) * half_u - 3.0f;
    const float v = static_cast<float>(2 * patch.v + 1) * half_v - 3.0f;
    return {{u - half_u, v - half_v}, {u + half_u, v + half_v}, {u + half_u * x, v + half_v * y}};
  }

  Range range_of(uint32_t leaf, float x, float y) const {
    return range_of(apart(pieces_[leaf >> 16], leaf), x, y);
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;  // no node
  // A part this many halvings above a leaf, or fewer, is tried by the last expansion.
  static constexpr uint32_t kTried = 2;
  static constexpr float kMaxStep = 0.25f;  // of a half piece, that a foot is thought to go
  // What Newton's step gains of D^2 / 2 is lost in rounding where it is less than this of D^2.
  static constexpr float kRounding = 0x1p-23f;
  static constexpr uint32_t kMaxTurns = 6;
  static constexpr uint32_t kEvaluationWork = 7;  // in visits, beside its own
  // From a hint's 16 bits: the ends are the piece's own.
  static float start_at(uint32_t code) {
    if (code == 65535) return 1.0f;
    return static_cast<float>(code) * 0x1p-15f - 1.0f;
  }

  // To the part that was halved into this one, where that is no larger than a cell.
  static bool widen(PatchNode& patch, const Halvings& cell) {
    if (was_halved_u(patch)) {
      if (patch.made_u == cell.u) return false;
      --patch.made_u, ++patch.left_u, patch.u >>= 1;
    } else {
      if (patch.made_v == cell.v) return false;
      --patch.made_v, ++patch.left_v, patch.v >>= 1;
    }
    return true;
  }

  bool is_closed_in_cell(uint32_t node, const PatchNode& patch, const Best& best) {
    const Piece& piece = pieces_[node >> 16];
    const Halvings cell = cell_levels(piece, grids_[node >> 16]);
    const uint32_t leaf_u = (closed_ >> 7) & 127u, leaf_v = closed_ & 127u;
    if (patch.made_u < cell.u || patch.made_v < cell.v ||
        patch.u >> (patch.made_u - cell.u) != leaf_u >> (piece.level_u - cell.u) ||
        patch.v >> (patch.made_v - cell.v) != leaf_v >> (piece.level_v - cell.v))
      return false;
    return closes(patch, best);
  }

  void stored_bends(const Piece& piece, uint32_t leaf, SurfaceBends& bends) const {
    const Grid& grid = grids_[leaf >> 16];
    const uint32_t u = ((leaf >> 7) & 127u) - (1u << piece.level_u);
    const uint32_t v = (leaf & 127u) - (1u << piece.level_v);
    const PatchBend& stored = bends_[cell_of(piece, grid, u, v)];
#pragma GCC unroll 5
    for (uint32_t k = 0; k < 5; ++k) {
      bends.fixed[k] = in_units(grid.fixed_unit_m2, stored.fixed[k]);
      bends.turning[k] = in_units(grid.turning_unit_m, stored.turning[k]);
    }
  }

  void expand(uint32_t node, const Piece& piece, const SurfaceBends& bends, math::Vec3 q_m,
              const float (&at)[2], BandedBest& best, Quadratic& f) const {
    union Unset {  // else all is cleared by a call, and then set
      SurfacePoint point;
      Unset() {}
    } found;
    SurfacePoint& point = found.point;
    evaluate(piece, coefficients_, at[0], at[1], point);
    const math::Vec3 r_m = point.x - q_m;
    f.distance2 = dot(r_m, r_m);
    const bool is_best = best.take(f.distance2);
    if (is_best) {
      best.node = node;
      best.s = at[0];
      best.t = at[1];
      best.x = point.x;
      best.along[0] = point.du;
      best.along[1] = point.dv;
    }
    f.at[0] = at[0];
    f.at[1] = at[1];
    expand_about(point, r_m, loss_m_, noise_of(piece), bends, f);
    if (is_best)
      for (uint32_t k = 0; k < 3; ++k) best.bend[k] = f.bend[k];
  }

  static Outcome split(const Range& range, const Quadratic& f, float lower_m,
                       Half<Range> (&halves)[2]) {
    const float wide = range.high[0] - range.low[0], high = range.high[1] - range.low[1];
    const uint32_t axis = !(wide > 0.0f) ? 1 : !(high > 0.0f) ? 0 : f.doubtful_axis(range);
    const float middle = 0.5f * (range.low[axis] + range.high[axis]);
    if (!(middle > range.low[axis] && middle < range.high[axis])) return Outcome::kLost;
    for (uint32_t i = 0; i < 2; ++i) {
      Range& half = halves[i].range;
      half = range;
      (i == 0 ? half.high : half.low)[axis] = middle;
      const float own2 = f.least2(half);
      const float own_m = own2 > 0.0f ? math::square_root(own2) * (1.0f - 0x1p-21f) : 0.0f;
      halves[i].lower_m = own_m > lower_m ? own_m : lower_m;
      (void)f.next(half, half.start);
      // Along a ring of points equally near, as beside a pole, Newton's step is noise and ends at
      // an end of the half: from its middle the proof has half as far to reach.
      for (uint32_t k = 0; k < 2; ++k) {
        const float size = half.high[k] - half.low[k];
        const float slope = __builtin_fabsf(f.slope[k]) + __builtin_fabsf(f.bend[2 * k]) * size;
        if (slope <= f.slope_noise[k]) half.start[k] = half.low[k] + 0.5f * size;
      }
    }
    return Outcome::kSplit;
  }

  const Piece* pieces_;
  const float* coefficients_;
  const Grid* grids_;
  const PatchBend* bends_;
  uint32_t piece_count_;
  float loss_m_;
  math::Vec3 p_m_;
  Quadratic expansions_[2];
  const Quadratic* closed_by_ = expansions_;
  uint32_t closed_ = kNone;  // the leaf that an expansion closed last
  float upper2_ = 0.0f;      // the least D^2 of what was closed last
};

}  // namespace firmtouch::spline
