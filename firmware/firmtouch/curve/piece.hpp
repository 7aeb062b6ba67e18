#pragma once
// Closest point of one cubic piece, for .cpp files of this module only.

#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/run_search.hpp"
#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {

struct PieceFoot {
  Foot foot;      // t: of the piece's parameter, from the nearer end
  float doubt_m;  // no point of the piece is nearer than the foot by more than this
  bool is_done;   // the work sufficed
};

/// What is left of a query's budget, and what was taken beyond visits.
struct PieceWork {
  uint32_t left, charged;
  void charge(uint32_t units) { curve::charge(units, left, charged); }
};

/// More than any distance that comes here.
constexpr float kAnyReach_m = 0x1p62f;

/// Halvings of a piece in a query.
constexpr uint32_t kMaxCuts = 16;

/// Closest point of piece `segment`. The piece is halved until no cut can be nearer by more than
/// piece_slack_m(). A cut is closed where no Bernstein coefficient of the squared distance is less
/// than the best, as about the centre of an arc, or where the squared distance is convex: there
/// Newton's method ends at its least value.
/// Bounds: 2 kMaxCuts + 1 cuts, each begun while work is left; 0.7 KB of stack.
/// Result: doubt_m <= piece_slack_m() unless halvings ran out. No point that is nearer than
///         `reach_m`: an end, perhaps. Where the work ran out, the nearest point seen.
PieceFoot foot_on_piece(const View& curve, math::Vec3 p_m, uint32_t segment, float reach_m,
                        PieceWork& work);

/// All but the certificate, for a foot on a piece.
Closest answer_on_piece(const View& curve, const Foot& foot);

/// The same, of whatever kind the pieces are.
Closest any_answer(const View& curve, const Foot& foot);

static inline Track track_of(const View& curve) {
  return {curve.samples().data(), curve.samples().size(), curve.is_closed()};
}

/// What a distance to a piece may be off by beside doubt_m, u = 2^-24: the difference of two points
/// rounds by u d on each axis, and the sum of squares and its root by 3 u d more; Bezier points and
/// polynomials move a point of the piece by at most 16 u of its length, and a foot loses 38 u more.
static inline float piece_loss_m(float distance_m, float half_m) {
  return 0x1p-24f * (7.5f * distance_m + 128.0f * half_m) + 0x1p-58f;
}

/// Accepted error of a piece's answer. Far from the curve the rounding of float32 is larger.
static inline float piece_slack_m(const Head& head, float distance_m) {
  const float near_m = head.diagonal_m * 0x1p-23f, far_m = distance_m * 0x1p-22f;
  return near_m > far_m ? near_m : far_m;
}

/// Units of a straight segment's foot.
static inline uint32_t segment_work(bool compensated) { return compensated ? 4 : 1; }

/// The nearest point of a piece or segment.
PieceFoot any_foot(const View& curve, math::Vec3 p_m, uint32_t segment, bool compensated,
                   PieceWork& work);

}  // namespace firmtouch::curve
