#pragma once
// How near the parts of surfaces may be, for .cpp files of this module only.
#include "firmtouch/spline/surface/patch_grid.hpp"
#include "firmtouch/spline/surface/patch_node.hpp"
#include "firmtouch/spline/surface/point.hpp"

namespace firmtouch::spline {

/// The bound of a patch. The stored radii and half sides hold what float32 loses.
struct NodeBound {
  float lower_m;  // no point of it is nearer
  float x, y;     // where on it, from -1 to 1, the foot is thought to be
  // Where lower_m is below the limit, and it is no leaf: the half without the foot, and a bound of
  // it as seen from the whole; 0: none.
  uint32_t far_half;
  float far_m;
};

class PatchBounds {
 public:
  PatchBounds(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        grids_(model.grids().data()),
        corners_(model.corners().data()),
        radii_(model.radii().data()),
        overlaps_(model.overlaps().data()),
        boxes_(model.boxes().data()),
        p_m_(p_m) {}

  float box_m(uint32_t i) const {
    const Box& box = boxes_[i];
    const math::Vec3 from_m = p_m_ - vec3_at(box.centre_m);
    const math::Vec3 a = vec3_at(box.axis[0]), b = vec3_at(box.axis[1]);
    const math::Vec3 off{beyond(dot(a, from_m), box.half_m[0]),
                         beyond(dot(b, from_m), box.half_m[1]),
                         beyond(dot(cross(a, b), from_m), box.half_m[2])};
    return math::length(off) * (1.0f - 0x1p-19f);
  }

  /// The piece whose patches are queried from here on.
  const Piece& come_near(uint32_t piece) {
    if (piece != piece_) enter(piece);
    return *of_;
  }

  /// Whether a part of that piece is beyond the limit. u and v: with a 1 before their digits; left:
  /// halvings to a leaf; next_u: its halves are of u.
  [[gnu::always_inline]] bool is_beyond(uint32_t u, uint32_t v, uint32_t left_u, uint32_t left_v,
                                        bool next_u, float limit_m, NodeBound& reported) const {
    const uint32_t along = columns_ << left_v;
    const Quad p = quarters_between(first_ + v * along + (u << left_u), 1u << left_u, along);
    Seen seen;
    see(p, q_, seen);
    Foot foot;
    foot_on(p, seen, foot);
    const uint32_t in_order = ((v - 1) << (of_->level_u - left_u)) + u - 1;
    const float radius_m = in_units(radius_unit_m_, piece_radii_[in_order]);
    reported.lower_m = foot.distance * quarter_m_ - radius_m;
    if (reported.lower_m >= limit_m) return true;
    if (left_u + left_v == 0) {
      reported.x = foot.x, reported.y = foot.y;
      return false;
    }
    const float overlap = in_overlaps(piece_overlaps_[in_order]);
    const float on = next_u ? foot.x : foot.y, excess = __builtin_fabsf(on) - overlap;
    reported.far_half = math::bits_of(on) >> 31;
    reported.far_m = 0.0f;
    if (excess > 0.0f) {
      const Axis u_axis{p.a, foot.x}, v_axis{p.b, foot.y};
      const float off =
          next_u ? half_bound(foot, u_axis, v_axis, p.twist, seen.ab, seen.per_bb, excess)
                 : half_bound(foot, v_axis, u_axis, p.twist, seen.ab, seen.per_aa, excess);
      reported.far_m = off * quarter_m_ - radius_m;
    }
    return false;
  }

 private:
  [[gnu::noinline]] void enter(uint32_t piece) {
    const Grid& grid = grids_[piece];
    piece_ = piece;
    of_ = pieces_ + piece;
    columns_ = (1u << of_->level_u) + 1u;
    first_ = corners_ + grid.first_corner - (columns_ << of_->level_v) - (1u << of_->level_u);
    piece_radii_ = radii_ + (2 * grid.first_leaf - piece);
    piece_overlaps_ = overlaps_ + (grid.first_leaf - piece);
    radius_unit_m_ = grid.radius_unit_m;
    const float quarter_m = 0.25f * grid.step_m;
    quarter_m_ = quarter_m * (1.0f - 0x1p-20f);
    q_ = (p_m_ - vec3_at(of_->origin_m)) * (1.0f / quarter_m);
  }
  static float beyond(float along, float half) {
    const float off = __builtin_fabsf(along) - half;
    return math::larger(off, 0.0f);
  }

  const Piece* pieces_;
  const Grid* grids_;
  const Corner* corners_;
  const uint8_t *radii_, *overlaps_;
  const Box* boxes_;
  math::Vec3 p_m_;
  // Of the piece:
  uint32_t piece_ = UINT32_MAX;
  uint32_t columns_;
  const Piece* of_;
  const Corner* first_;  // less what the 1s before u and v come to
  const uint8_t *piece_radii_, *piece_overlaps_;
  float quarter_m_, radius_unit_m_;
  math::Vec3 q_;  // the query, in quarters of a step, a power of two: exactly as in metres
};

}  // namespace firmtouch::spline
