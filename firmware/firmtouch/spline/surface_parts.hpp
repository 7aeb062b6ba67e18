#pragma once
// The parts of surfaces for Search, for .cpp files of this room only.
#include "firmtouch/spline/evaluation.hpp"
#include "firmtouch/spline/leaf_shape.hpp"
#include "firmtouch/spline/quadratic.hpp"

namespace firmtouch::spline {

class SurfaceParts {
 public:
  using Range = Rectangle;

  SurfaceParts(const View& model, math::Vec3 p_m)
      : pieces_(model.pieces().data()),
        coefficients_(model.coefficients().data()),
        leaves_(model.leaves().data()),
        bends_(model.bends().data()),
        boxes_(model.boxes().data()),
        loss_m_(model.head().loss_m),
        p_m_(p_m) {}

  Range whole(uint32_t) const { return {{-1.0f, -1.0f}, {1.0f, 1.0f}, {0.0f, 0.0f}}; }

  /// Of the leaf of a hint, from where it was left.
  Range resumed(uint32_t, uint32_t code) const {
    const float u = 2.0f * decoded(code >> 8, 255) - 1.0f;
    const float v = 2.0f * decoded(code & 0xFFu, 255) - 1.0f;
    return {{-1.0f, -1.0f}, {1.0f, 1.0f}, {u, v}};
  }
  uint32_t place_in(uint32_t leaf, const Best& best) const {
    const Part part = part_of(pieces_[leaves_[leaf].piece], leaves_[leaf]);
    const float u = (best.s - part.middle_u) / part.half_u;
    const float v = (best.t - part.middle_v) / part.half_v;
    return coded(0.5f * (u + 1.0f), 255) << 8 | coded(0.5f * (v + 1.0f), 255);
  }

  // The stored half sides hold what float32 loses here.
  float bound_m(uint32_t node) const {
    const Box& box = boxes_[node];
    const math::Vec3 from_m = p_m_ - vec3_at(box.centre_m);
    const math::Vec3 a = vec3_at(box.axis[0]), b = vec3_at(box.axis[1]);
    const math::Vec3 off{beyond(dot(a, from_m), box.half_m[0]),
                         beyond(dot(b, from_m), box.half_m[1]),
                         beyond(dot(cross(a, b), from_m), box.half_m[2])};
    return math::length(off) * (1.0f - 0x1p-19f);
  }

  Outcome solve(uint32_t leaf, Range& range, float lower_m, uint32_t& left, Best& best,
                Half<Range> (&halves)[2]) {
    const float wide = range.high[0] - range.low[0], high = range.high[1] - range.low[1];
    const bool is_own = wide * high <= kSmall && left >= kDerivation;
    const Frame frame = is_own ? frame_of(leaf, range) : frame_of(leaf);
    if (is_own) left -= kDerivation;
    Range inside = range;
    if (is_own) inside = {{-1.0f, -1.0f}, {1.0f, 1.0f}, {0.0f, 0.0f}};
    const Outcome outcome = close(leaf, frame, inside, lower_m, left, best, halves);
    if (!is_own) {
      range = inside;
    } else if (outcome == Outcome::kSplit) {
      for (Half<Range>& half : halves) half.range = placed(half.range, range);
    }
    return outcome;
  }

 private:
  static constexpr uint32_t kMostTurns = 5;
  // A rectangle of so little of a leaf's 4 gets bends of its own, for the price of so many steps. The
  // leaf's are too wide where a row of control points is one point: there they shrink with the
  // rectangle, and without that some queries took millions of evaluations.
  static constexpr float kSmall = 0.3f;
  static constexpr uint32_t kDerivation = 8;

  /// What local coordinates of -1 to 1 cover of the piece, and the bends there.
  struct Frame {
    Part part;
    float fixed[4], turning[4];
  };

  Frame frame_of(uint32_t leaf) const {
    Frame frame;
    frame.part = part_of(pieces_[leaves_[leaf].piece], leaves_[leaf]);
    for (uint32_t k = 0; k < 4; ++k) {
      frame.fixed[k] = from_half(bends_[4 * leaf + k].fixed);
      frame.turning[k] = from_half(bends_[4 * leaf + k].turning);
    }
    return frame;
  }

  Frame frame_of(uint32_t leaf, const Range& range) const {
    const Piece& piece = pieces_[leaves_[leaf].piece];
    const Part part = part_of(piece, leaves_[leaf]);
    Frame frame;
    frame.part.half_u = part.half_u * (0.5f * (range.high[0] - range.low[0]));
    frame.part.half_v = part.half_v * (0.5f * (range.high[1] - range.low[1]));
    frame.part.middle_u = part.middle_u + part.half_u * (0.5f * (range.high[0] + range.low[0]));
    frame.part.middle_v = part.middle_v + part.half_v * (0.5f * (range.high[1] + range.low[1]));
    LeafShape shape;
    derive(piece, coefficients_ + piece.coefficients, frame.part, shape);
    for (uint32_t k = 0; k < 4; ++k) {
      frame.fixed[k] = shape.fixed[k];
      frame.turning[k] = shape.turning[k];
    }
    return frame;
  }

  // From a rectangle's own coordinates to the leaf's. Halving is exact, for widths are powers of two.
  static Range placed(const Range& inside, const Range& range) {
    Range made;
    for (uint32_t k = 0; k < 2; ++k) {
      const float middle = 0.5f * (range.low[k] + range.high[k]);
      const float half = 0.5f * (range.high[k] - range.low[k]);
      made.low[k] = middle + half * inside.low[k];
      made.high[k] = middle + half * inside.high[k];
      made.start[k] = middle + half * inside.start[k];
    }
    return made;
  }

  Outcome close(uint32_t leaf, const Frame& frame, Range& range, float lower_m, uint32_t& left,
                Best& best, Half<Range> (&halves)[2]) {
    float at[2] = {range.start[0], range.start[1]};
    Quadratic base;
    base.distance2 = FLT_MAX;
    for (uint32_t turn = 0; turn < kMostTurns; ++turn) {
      if (left == 0) {
        range.start[0] = at[0];
        range.start[1] = at[1];
        return Outcome::kStopped;
      }
      --left;
      Quadratic f;
      expand(leaf, frame, at, best, f);
      if (best.is_beyond(f.least2(range))) return Outcome::kClosed;
      if (f.distance2 < base.distance2) {
        base = f;
        base.next(range, at);
      } else if (turn > 0) {  // too far along the way: a quarter of it
        for (uint32_t k = 0; k < 2; ++k) at[k] = base.at[k] + 0.25f * (at[k] - base.at[k]);
      }
      const float moved =
          (at[0] - base.at[0]) * (at[0] - base.at[0]) + (at[1] - base.at[1]) * (at[1] - base.at[1]);
      if (!(moved > 0x1p-40f)) break;
    }
    return split(range, base, lower_m, halves);
  }

  static float beyond(float along, float half) {
    const float off = (along < 0.0f ? -along : along) - half;
    return off > 0.0f ? off : 0.0f;
  }

  void expand(uint32_t leaf, const Frame& frame, const float (&at)[2], Best& best,
              Quadratic& f) const {
    const Piece& piece = pieces_[leaves_[leaf].piece];
    const Part& part = frame.part;
    const float s = part.middle_u + part.half_u * at[0], t = part.middle_v + part.half_v * at[1];
    ++best.evaluations;
    SurfacePoint point;
    evaluate(piece, coefficients_, s, t, point);
    const math::Vec3 r_m = point.x - (p_m_ - vec3_at(piece.origin_m));
    f.distance2 = dot(r_m, r_m);
    if (best.take(f.distance2)) {
      best.leaf = leaf;
      best.s = s;
      best.t = t;
      best.x = point.x;
      best.along[0] = point.du;
      best.along[1] = point.dv;
    }
    const math::Vec3 du = point.du * part.half_u, dv = point.dv * part.half_v;
    f.at[0] = at[0];
    f.at[1] = at[1];
    f.slope[0] = dot(r_m, du);
    f.slope[1] = dot(r_m, dv);
    f.gauss[0] = dot(du, du);
    f.gauss[1] = dot(du, dv);
    f.gauss[2] = dot(dv, dv);
    f.bend[0] = f.gauss[0] + part.half_u * part.half_u * dot(r_m, point.duu);
    f.bend[1] = f.gauss[1] + part.half_u * part.half_v * dot(r_m, point.duv);
    f.bend[2] = f.gauss[2] + part.half_v * part.half_v * dot(r_m, point.dvv);
    const float distance_m = math::square_root(f.distance2);
    const float speed_u = size_of(du), speed_v = size_of(dv);
    const float lost_m = loss_m_ + 6.0f * kUnit * distance_m;
    f.slope_noise[0] = speed_u * lost_m + kSlopeNoise * loss_m_ * distance_m * part.half_u;
    f.slope_noise[1] = speed_v * lost_m + kSlopeNoise * loss_m_ * distance_m * part.half_v;
    // The noise of the mixed derivative is shared between the two axes: 2 |u v| <= u^2 + v^2.
    const float mixed = loss_m_ * (part.half_u * speed_v + part.half_v * speed_u);
    f.bend_noise[0] =
        kBendNoise * (2.0f * loss_m_ * part.half_u * (speed_u + distance_m * part.half_u) + mixed) +
        16.0f * kUnit *
            (f.gauss[0] + distance_m * size_of(point.duu) * part.half_u * part.half_u +
             speed_u * speed_v + distance_m * size_of(point.duv) * part.half_u * part.half_v);
    f.bend_noise[1] =
        kBendNoise * (2.0f * loss_m_ * part.half_v * (speed_v + distance_m * part.half_v) + mixed) +
        16.0f * kUnit *
            (f.gauss[2] + distance_m * size_of(point.dvv) * part.half_v * part.half_v +
             speed_u * speed_v + distance_m * size_of(point.duv) * part.half_u * part.half_v);
    for (uint32_t k = 0; k < 4; ++k)
      f.change[k] = (frame.fixed[k] + frame.turning[k] * distance_m) * (1.0f + 0x1p-20f);
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
      for (uint32_t j = 0; j < 2; ++j) half.start[j] = 0.5f * (half.low[j] + half.high[j]);
    }
    return Outcome::kSplit;
  }

  const Piece* pieces_;
  const float* coefficients_;
  const Leaf* leaves_;
  const Bend* bends_;
  const Box* boxes_;
  float loss_m_;
  math::Vec3 p_m_;
};

}  // namespace firmtouch::spline
