#pragma once
// The oriented box of a leaf, decoded, and what open() proves of it. For the library's own
// translation units.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/box_frame.hpp"

namespace firmtouch::mesh {

/// Bound of the errors of query and corner together on each axis: 1.012 for the query's rounding,
/// the rest for holds(). With boxes in a frame what turned() rounds of both is added.
constexpr float kErrorHalfCells = 1.02f;
constexpr float kTurnedErrorHalfCells = kErrorHalfCells + 2.0f * kTurnedSlackCells;

/// An oriented box as tools/FORMAT.md (0x100E) has it: with c the centre, in half cells less 2^15,
/// and a each axis, every x of the leaf has |a . (x - c)| <= half 2^16.
///
/// math::oriented_distance2() is never more than the true distance: let q be the query, d = q - c
/// as it is computed, saturated, and t the same of the exact query. d is off by at most 1.012 on
/// each axis (math::half_cell_point()). Saturating moves t to the nearest point of a cube that
/// holds the leaf (holds()), so not away from any x of it. An axis' gap is (|a . d| 2^-16) - half,
/// rounded down, and half covers both |a . (x - c)| and 1.012 |a|_1: so it is at most |a . (t - (x
/// - c))| 2^-16, and the squares of all three sum to at most s^2 |t - (x - c)|^2 2^-32 with s the
/// most by which the axes lengthen a vector. s^2 <= 2^30 (are_axes_sound(), by Gershgorin's
/// circles), and half cells are half as long as cells: the result is the squared distance in cells.
/// No sum passes 2^31, for no axis is longer than 2^15 and no d than 2^15 sqrt(3). (A leaf of one
/// triangle has no box but halves that no offset exceeds: the words read as its axes do not
/// matter.)
struct LeafBox {
  int32_t axis[3][3];
  int32_t centre[3];
  uint32_t half[3];

  explicit LeafBox(const uint32_t* words) {
    const auto low = [&](int i) {
      return static_cast<int32_t>(static_cast<int16_t>(words[i] & 0xFFFFu));
    };
    const auto high = [&](int i) {
      return static_cast<int32_t>(static_cast<int16_t>(words[i] >> 16));
    };
    half[0] = words[0] & 0xFFFFu;
    half[1] = words[0] >> 16;
    half[2] = words[1] >> 16;
    centre[0] = low(2);
    centre[1] = high(2);
    centre[2] = low(3);
    for (int k = 0; k < 3; ++k) {
      axis[k][0] = low(4 + k);
      axis[k][1] = high(4 + k);
    }
    axis[0][2] = low(7);
    axis[1][2] = high(7);
    axis[2][2] = high(3);
  }

  /// Whether they lengthen no vector by more than 2^15.
  bool are_axes_sound() const {
    for (int i = 0; i < 3; ++i) {
      uint64_t sum = 0;
      for (int j = 0; j < 3; ++j) {
        int64_t product = 0;
        for (int k = 0; k < 3; ++k) product += int64_t{axis[i][k]} * axis[j][k];
        sum += static_cast<uint64_t>(product < 0 ? -product : product);
      }
      if (sum > uint64_t{1} << 30) return false;
    }
    return true;
  }

  /// Whether it holds a corner at these coordinates in cells, each within 2^-9 of the true one, and
  /// the query's error with it. `error`: kErrorHalfCells or kTurnedErrorHalfCells. This computation
  /// loses less than the 2^11 that are added to the bound: each x - c 0.006 half cells, and the
  /// sums 2^10.
  bool holds(math::Vec3 cells, float error) const {
    const float at[3] = {cells.x, cells.y, cells.z};
    float from_centre[3];
    for (int k = 0; k < 3; ++k) {
      from_centre[k] = 2.0f * at[k] - static_cast<float>(32768 + centre[k]);
      if (!(__builtin_fabsf(from_centre[k]) <= 32766.0f)) return false;
    }
    for (int k = 0; k < 3; ++k) {
      float along = 0, lengths = 0;
      for (int i = 0; i < 3; ++i) {
        const float a = static_cast<float>(axis[k][i]);
        along += a * from_centre[i];
        lengths += __builtin_fabsf(a);
      }
      if (!(__builtin_fabsf(along) + error * lengths + 0x1p11f <=
            0x1p16f * static_cast<float>(half[k])))
        return false;
    }
    return true;
  }
};

}  // namespace firmtouch::mesh
