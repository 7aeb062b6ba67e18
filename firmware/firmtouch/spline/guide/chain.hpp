#pragma once
// Which pieces of a guide follow each other, for .cpp files of this module only.
#include "firmtouch/core/bisect.hpp"
#include "firmtouch/spline/guide/view.hpp"

namespace firmtouch::spline {

static inline uint32_t chain_of(const GuideView& guide, uint32_t piece) {
  return core::last_that(guide.chains().size(),
                         [&](uint32_t i) { return guide.chains()[i].first_piece <= piece; });
}

/// The piece behind its last one.
static inline uint32_t end_of(const GuideView& guide, uint32_t chain) {
  return chain + 1 < guide.chains().size() ? guide.chains()[chain + 1].first_piece
                                           : guide.model().pieces().size();
}

constexpr uint32_t kNoPiece = UINT32_MAX;

/// The piece that goes on from an end of one; kNoPiece where the curve ends.
static inline uint32_t beyond(const GuideView& guide, uint32_t piece, bool is_forward) {
  const uint32_t chain = chain_of(guide, piece);
  const uint32_t first = guide.chains()[chain].first_piece, last = end_of(guide, chain) - 1;
  const bool is_closed = guide.chains()[chain].is_closed != 0;
  if (is_forward) return piece < last ? piece + 1 : is_closed ? first : kNoPiece;
  return piece > first ? piece - 1 : is_closed ? last : kNoPiece;
}

/// A chain by its arcs: where changes of arc may go round.
struct Round {
  uint32_t first_piece = 0, end_piece = 0;  // from the first to before the end
  float first_m = 0, last_m = 0;
  bool is_closed = false;

  bool goes_round(uint32_t piece) const {
    return is_closed && piece >= first_piece && piece < end_piece;
  }
  float length_m() const { return last_m - first_m; }
};

static inline Round round_of(const GuideView& guide, uint32_t piece) {
  const uint32_t chain = chain_of(guide, piece);
  Round round;
  round.first_piece = guide.chains()[chain].first_piece;
  round.end_piece = end_of(guide, chain);
  round.first_m = guide.arcs()[round.first_piece * guide.intervals()];
  round.last_m = guide.arcs()[round.end_piece * guide.intervals()];
  round.is_closed = guide.chains()[chain].is_closed != 0;
  return round;
}

/// From an arc position of the chain to one of `piece`: the shorter way round where both are on one
/// that is closed, signed.
static inline float change_of_arc_m(const Round& round, float from_m, uint32_t piece, float to_m) {
  const float change_m = to_m - from_m;
  if (!round.goes_round(piece)) return change_m;
  const float half_m = 0.5f * round.length_m();
  return change_m > half_m    ? change_m - round.length_m()
         : change_m < -half_m ? change_m + round.length_m()
                              : change_m;
}

}  // namespace firmtouch::spline
