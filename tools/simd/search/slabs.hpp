#pragma once
// A segment against four boxes at once. Compiled once per level.

#include "firmtouch/math/slabs.hpp"
#include "simd/search/entries.hpp"
#include "simd/search/four_floats.hpp"
#include "simd/wide_tree.hpp"

namespace firmtouch::simd {

/// math::Slabs of four boxes, with a limit of 1: the same formulas in the same order, so the same
/// bits.
class FourSlabs {
 public:
  [[gnu::always_inline]] inline bool begin(math::Vec3 a_in, math::Vec3 b_in, const float* low_in,
                                           float cell, float slack_cells = math::kSlabSlackCells) {
    const Float4 a{a_in.x, a_in.y, a_in.z, 0.0f}, b{b_in.x, b_in.y, b_in.z, 0.0f};
    const Float4 grid_low{low_in[0], low_in[1], low_in[2], 0.0f};
    const Float4 per_cell = four_of(math::float_of((254u << 23) - math::bits_of(cell)));
    const Float4 origin = (a - grid_low) * per_cell, step = (b - a) * per_cell;
    const Mask4 sign = as_bits(four_of(-0.0f));
    const Float4 offset = as_floats(as_bits(origin) & ~sign),
                 size = as_floats(as_bits(step) & ~sign);
    const Float4 slack = offset * four_of(0x1p-21f) + four_of(slack_cells);
    const Float4 low = origin + slack, high = four_of(32767.0f) - (origin - slack);
    const Mask4 back = step < four_of(0.0f), turn = (as_bits(low) ^ as_bits(high)) & back;
    const Float4 far = four_of(math::kFarCells);
    const uint32_t is_back = bits_of(back);
    near_[0] = 4 * (is_back & 1u), near_[1] = 8 + 2 * (is_back & 2u),
    near_[2] = 16 + (is_back & 4u);
    far_[0] = near_[0] ^ 4u, far_[1] = near_[1] ^ 4u, far_[2] = near_[2] ^ 4u;
    spread(as_floats(as_bits(low) ^ turn), as_floats(as_bits(high) ^ turn),
           four_of(1.0f) / larger(size, four_of(math::kStillCells)));
    if (bits_of((offset <= far) & (size <= far)) == 15) return true;
    spread(four_of(32768.0f), four_of(32768.0f), four_of(1.0f));
    return false;
  }

  /// Keys of the boxes in one child of the node, and in the other.
  [[gnu::always_inline]] inline void enter(const SegmentNode& node, uint64_t& one_keys,
                                           uint64_t& other_keys) const {
    const auto in = [&](uint32_t k) {
      return (four_from(node.planes + near_[k]) - enter_[k]) * rate_[k];
    };
    const auto out = [&](uint32_t k) {
      return (leave_[k] - four_from(node.planes + far_[k])) * rate_[k];
    };
    const Float4 first = larger(larger(in(0), in(1)), larger(in(2), four_of(0.0f)));
    const Float4 last = smaller(smaller(out(0), out(1)), smaller(out(2), four_of(1.0f)));
    typedef uint64_t Keys __attribute__((vector_size(16)));
    const Keys keys = reinterpret_cast<Keys>(as_bits(first) | (last < first));
    one_keys = keys[0], other_keys = keys[1];
  }

 private:
  // Every axis in four lanes.
  [[gnu::always_inline]] inline void spread(Float4 enter, Float4 leave, Float4 rate) {
    enter_[0] = four_of(enter[0]), leave_[0] = four_of(leave[0]), rate_[0] = four_of(rate[0]);
    enter_[1] = four_of(enter[1]), leave_[1] = four_of(leave[1]), rate_[1] = four_of(rate[1]);
    enter_[2] = four_of(enter[2]), leave_[2] = four_of(leave[2]), rate_[2] = four_of(rate[2]);
  }

  size_t near_[3], far_[3];  // where SegmentNode::planes has those that are entered, and left
  Float4 enter_[3], leave_[3], rate_[3];
};

}  // namespace firmtouch::simd
