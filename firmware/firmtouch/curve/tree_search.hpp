#pragma once
// Traversal of a curve's k-d tree, for .cpp files of this module only.

#include <float.h>

#include "firmtouch/curve/derived.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::curve {

/// Offers every sample that may matter to a visitor: from the root greedily down to a leaf, then
/// from the nearest cell that is left.
///
/// The visitor has
///     float radius_m() const;   what lies farther has nothing for it
///     void take(uint32_t sample, math::Vec3 from_sample_m, float distance2_m2);
/// Its radius never grows and is rounded up by a millionth: what is farther in squares of float32
/// is farther in truth.
///
/// A cell is the part of space that the planes above a node leave to it. Along a branch cells
/// shrink, so the bound of the nearest cell left never falls: more steps never widen a certificate,
/// and the order of steps does not depend on the budget.
///
/// Source: Arya & Mount 1993 (distance to cells, kept axis by axis).
template <class Visitor>
class TreeSearch {
 public:
  TreeSearch(const View& curve, math::Vec3 p_m, uint32_t budget, Visitor& visitor)
      : tree_(curve.tree().data()),
        samples_(curve.samples().data()),
        count_(curve.samples().size()),
        budget_(budget == 0 ? 1 : budget),
        left_(budget_),
        visitor_(visitor),
        p_m_{p_m.x, p_m.y, p_m.z} {
    const Head& head = curve.head();
    for (uint32_t k = 0; k < 3; ++k) {
      const float below_m = head.low_m[k] - p_m_[k], above_m = p_m_[k] - head.high_m[k];
      const float outside_m = below_m > 0.0f ? below_m : above_m > 0.0f ? above_m : 0.0f;
      outside2_m2_[k] = outside_m * outside_m;
    }
  }

  /// Result: true when nothing is left that the visitor would take; false when the budget ended.
  bool run() {
    uint32_t node = 0;
    for (;;) {
      if (!descend(node)) return false;
      uint32_t cell;
      if (!find_next(cell)) return true;
      if (left_ == 0) return false;
      node = take_up(cell);
    }
  }

  uint32_t steps() const { return budget_ - left_; }

  /// Certified distance to all that the budget left unseen.
  float pending_m() const {
    float min_m = FLT_MAX;
    for (uint32_t i = 0; i < pending_count_; ++i)
      min_m = pending_[i].bound_m < min_m ? pending_[i].bound_m : min_m;
    return min_m;
  }

 private:
  // Best first while there is room for a whole descent, last in first out beyond: then entries
  // above kBestFirst lie on one way down, at most one a level.
  static constexpr uint32_t kBestFirst = 24;
  static constexpr uint32_t kCapacity = kBestFirst + kMaxLevels + 1;

  struct Cell {
    uint32_t node;
    float bound_m;
    float outside2_m2[3];  // squared distance to the cell, axis by axis
  };

  // Distance to a cell, rounded down: the sum of squares loses 5 roundings, the root halves them
  // and adds one.
  static float bound_m(const float* outside2_m2) {
    const float distance2_m2 = outside2_m2[0] + outside2_m2[1] + outside2_m2[2];
    return math::square_root(distance2_m2) * (1.0f - 0x1p-21f);
  }

  // From a node for which there is budget to a leaf, the nearer child first. Squares of lengths are
  // compared as integers: of two that are not negative the order is the same, in fewer
  // instructions.
  bool descend(uint32_t node) {
    const math::Vec3 p_m{p_m_[0], p_m_[1], p_m_[2]};
    const uint32_t cell2 = math::bits_of(outside2_m2_[0] + outside2_m2_[1] + outside2_m2_[2]);
    uint32_t limit2 = limit();
    do {
      if (left_ == 0) {
        put(node);
        return false;
      }
      --left_;
      const uint32_t word = tree_[node];
      if (cell2 >= limit2) return true;
      const uint32_t sample = sample_of(word), axis = axis_of(word);
      const float* at_m = &samples_[sample].x_m;
      const math::Vec3 from_m{p_m.x - at_m[0], p_m.y - at_m[1], p_m.z - at_m[2]};
      const float distance2_m2 = dot(from_m, from_m);
      if (math::bits_of(distance2_m2) < limit2) {
        visitor_.take(sample, from_m, distance2_m2);
        limit2 = limit();
      }
      const float beyond_m = p_m_[axis] - at_m[axis];
      const float beyond2_m2 = beyond_m * beyond_m;
      const uint32_t is_before = math::bits_of(beyond_m) >> 31;
      const uint32_t first = first_child(node);
      if (math::bits_of(beyond2_m2) < limit2)
        put_other(first + is_before, axis, beyond2_m2, limit2);
      node = first + 1 - is_before;
    } while (node < count_);
    return true;
  }

  uint32_t limit() const {
    const float radius_m = visitor_.radius_m();
    return math::bits_of(radius_m * radius_m);
  }

  void put(uint32_t node) {
    Cell& cell = pending_[pending_count_++];
    cell.node = node;
    cell.bound_m = bound_m(outside2_m2_);
    for (uint32_t k = 0; k < 3; ++k) cell.outside2_m2[k] = outside2_m2_[k];
  }

  void put_other(uint32_t node, uint32_t axis, float beyond2_m2, uint32_t limit2) {
    if (node >= count_) return;
    Cell& cell = pending_[pending_count_];
    for (uint32_t k = 0; k < 3; ++k) cell.outside2_m2[k] = outside2_m2_[k];
    cell.outside2_m2[axis] = beyond2_m2;
    const float sum_m2 = cell.outside2_m2[0] + cell.outside2_m2[1] + cell.outside2_m2[2];
    if (math::bits_of(sum_m2) >= limit2) return;
    cell.node = node;
    cell.bound_m = bound_m(cell.outside2_m2);
    ++pending_count_;
  }

  // Result: false when no cell that is left can matter any more.
  bool find_next(uint32_t& cell) {
    while (pending_count_ > kBestFirst) {
      cell = pending_count_ - 1;
      if (pending_[cell].bound_m < visitor_.radius_m()) return true;
      --pending_count_;
    }
    if (pending_count_ == 0) return false;
    cell = 0;
    for (uint32_t i = 1; i < pending_count_; ++i)
      if (pending_[i].bound_m < pending_[cell].bound_m) cell = i;
    return pending_[cell].bound_m < visitor_.radius_m();
  }

  uint32_t take_up(uint32_t cell) {
    const Cell taken = pending_[cell];
    pending_[cell] = pending_[--pending_count_];
    for (uint32_t k = 0; k < 3; ++k) outside2_m2_[k] = taken.outside2_m2[k];
    return taken.node;
  }

  const uint32_t* tree_;
  const Sample* samples_;
  uint32_t count_;
  uint32_t budget_;
  uint32_t left_;
  Visitor& visitor_;
  float p_m_[3];
  float outside2_m2_[3];  // of the cell that is being looked at
  uint32_t pending_count_ = 0;
  Cell pending_[kCapacity];
};

}  // namespace firmtouch::curve
