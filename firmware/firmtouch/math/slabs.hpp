#pragma once
// A segment against boxes on a grid. For the library's own translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::math {

/// A segment in cells of a grid: where it begins, and how far it goes.
struct GridSegment {
  float origin[3], step[3];
};

/// The segment from `a` to `b` on a grid that begins at `low`.
/// Pre: `cell` is a power of two.
///
/// With u = 2^-24 and o the origin in cells: o is off by u |o|, the box check by 2^-9 cells, rate
/// and each plane's difference by 3 u of the plane's distance, at most |o| + 32768: 4 u |o| + 2^-7
/// in all. Slabs widen boxes by twice that.
static inline GridSegment on_grid(Vec3 a, Vec3 b, const float* low, float cell) {
  const float per_cell = 1.0f / cell;
  return {{(a.x - low[0]) * per_cell, (a.y - low[1]) * per_cell, (a.z - low[2]) * per_cell},
          {(b.x - a.x) * per_cell, (b.y - a.y) * per_cell, (b.z - a.z) * per_cell}};
}

// An axis along which the segment stands still (less than this in cells) has so high a rate that
// the whole segment is inside a slab, or outside. A segment beyond kFarCells is not bounded.
constexpr float kStillCells = 1e-30f;
constexpr float kFarCells = 0x1p60f;
constexpr uint32_t kNotEntered = UINT32_MAX;
constexpr float kSlabSlackCells = 0x1p-6f;

/// The slabs of boxes as a segment meets them. A box's word is low | (32767 - high) << 16; turned
/// by `turn` (0 or 16) its low half is the plane where the segment enters, its high half the one
/// where it leaves: entry = (low half - enter) * rate, exit = (leave - high half) * rate, rate > 0
/// in segments a cell. Boxes are widened by |origin| 2^-21 + `slack_cells`, rounded.
class Slabs {
 public:
  /// False: the segment is too far off, or not finite; every box is entered at 0.
  bool begin(const GridSegment& segment, float slack_cells = kSlabSlackCells) {
    bool is_near = true;
    for (uint32_t k = 0; k < 3; ++k) {
      const float origin = segment.origin[k], step = segment.step[k];
      const float offset = origin < 0.0f ? -origin : origin, size = step < 0.0f ? -step : step;
      is_near = is_near && offset <= kFarCells && size <= kFarCells;
      const float slack = offset * 0x1p-21f + slack_cells;
      const float low = origin + slack, high = 32767.0f - (origin - slack);
      turn_[k] = step < 0.0f ? 16u : 0u;
      enter_[k] = step < 0.0f ? high : low;
      leave_[k] = step < 0.0f ? low : high;
      rate_[k] = 1.0f / (size > kStillCells ? size : kStillCells);
    }
    for (uint32_t k = 0; k < 3 && !is_near; ++k) {
      enter_[k] = leave_[k] = 32768.0f;
      rate_[k] = 1.0f;
    }
    return is_near;
  }
  void set_limit(float limit) { limit_ = limit; }

  /// Of two boxes of three words each, a word between them: the bits of the entry where the segment
  /// enters no later than the limit, else kNotEntered.
  void enter(const uint32_t* boxes, uint32_t* key) const {
    for (uint32_t box = 0; box < 2; ++box) {
      float first = 0.0f, last = limit_;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t word = boxes[4 * box + k], turn = turn_[k];
        const uint32_t near_half = (word >> turn) & 0xFFFFu;
        const uint32_t far_half = (word >> (16 - turn)) & 0xFFFFu;
        const float in = (static_cast<float>(near_half) - enter_[k]) * rate_[k];
        const float out = (leave_[k] - static_cast<float>(far_half)) * rate_[k];
        first = in > first ? in : first;
        last = out < last ? out : last;
      }
      key[box] = first <= last ? bits_of(first) : kNotEntered;
    }
  }

 private:
  uint32_t turn_[3];
  float enter_[3], leave_[3], rate_[3];
  float limit_ = 0;
};

}  // namespace firmtouch::math
