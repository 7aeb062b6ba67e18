// The bound of an oriented box: its variants agree, and it is what its words say.
#include "firmtouch/math/isa.hpp"

#include <stdint.h>

#include "harness/random.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;

namespace {

firmtouch::test::Xorshift next_random(5);

uint32_t pair_of(int32_t low, int32_t high) {
  return (static_cast<uint32_t>(low) & 0xFFFFu) | static_cast<uint32_t>(high) << 16;
}

// No axis is longer than 2^15, as open() requires: three of these are.
int32_t component() { return static_cast<int32_t>(next_random() % 37800u) - 18900; }

struct Box {
  uint32_t words[8];

  explicit Box(bool is_extreme) {
    words[0] = next_random() & 0x0FFF0FFFu;
    words[1] = (next_random() & 0x0FFFu) << 16 | 0xFFFFu;
    words[2] = next_random();
    words[3] = pair_of(static_cast<int32_t>(next_random() >> 16), component());
    for (int k = 4; k < 8; ++k) words[k] = pair_of(component(), component());
    if (is_extreme) {  // one axis along y, as long as may be, and a centre in a corner of the grid
      words[2] = pair_of(32767, -32768);
      words[4] = pair_of(0, -32768);
      words[7] = pair_of(0, component());
    }
  }
};

}  // namespace

TEST(OrientedBoxVariantsAgree) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const Box box(i % 8 == 0);
    math::HalfCellPoint point{next_random(), next_random() & 0xFFFFu};
    if (i % 4 == 0) point.xy = (i & 16u) != 0 ? pair_of(-32768, 32767) : pair_of(32767, -32768);
    if (i % 4 == 1) point.xy = box.words[2] + (next_random() & 0x00FF00FFu);  // near by
    if (math::oriented_distance2(box.words, point) !=
        math::portable::oriented_distance2(box.words, point))
      ++differ;
  }
  CHECK_EQ(differ, 0u);
}

TEST(OrientedBox_SumsSquaredGapsInCells) {
  // Turned by a right angle about z: axis 0 along y, axis 1 against x, axis 2 along z.
  const uint32_t box[8] = {pair_of(100, 20),    pair_of(-1, 5),    pair_of(1000, -2000),
                           pair_of(300, 32000), pair_of(0, 32000), pair_of(-32000, 0),
                           pair_of(0, 0),       pair_of(0, 0)};
  const auto at = [&](int32_t x, int32_t y, int32_t z) {  // half cells from the centre
    return math::oriented_distance2(
        box, {pair_of(1000 + x, -2000 + y), static_cast<uint32_t>(300 + z) & 0xFFFFu});
  };
  CHECK_EQ(at(0, 0, 0), 0u);
  CHECK_EQ(at(40, 200, 10), 0u);
  CHECK_EQ(at(0, 400, 0), 95u * 95u);  // 195.3 cells along an axis of 32,000
  CHECK_EQ(at(0, -400, 0), 95u * 95u);
  CHECK_EQ(at(400, 0, 0), 175u * 175u);
  CHECK_EQ(at(-400, 400, -400), 175u * 175u + 95u * 95u + 190u * 190u);
}

TEST(BoxOfLongestHalves_ExcludesNothing) {
  uint32_t reported = 0;
  for (uint32_t i = 0; i < 1000; ++i) {
    Box box(i % 2 == 0);
    box.words[0] = box.words[1] = 0xFFFFFFFFu;
    if (i % 4 < 2)
      for (int k = 2; k < 8; ++k) box.words[k] = i % 4 == 0 ? next_random() : 0x80008000u;
    if (math::oriented_distance2(box.words, {next_random(), next_random() & 0xFFFFu}) != 0)
      ++reported;
  }
  CHECK_EQ(reported, 0u);
}

TEST(HalfCellsAreWithinOneAndAHundredthOfThePoint) {
  const float low[4] = {-1.0f, 2.0f, 0.0f, 0.0f};
  const float cell = 0x1p-14f, per_part = 0x1p16f / cell;
  uint32_t inside = 0, far = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    float at[3], cells[3];
    for (int k = 0; k < 3; ++k) {
      cells[k] = static_cast<float>(next_random() % (32767u * 64u)) * 0x1p-6f;
      if (i % 8 == 0) cells[k] = static_cast<float>(i % 16 == 0 ? 1 : 32765);
      at[k] = low[k] + cells[k] * cell;
      cells[k] = (at[k] - low[k]) / cell;
    }
    math::BoxPoint point;
    if (!math::grid_point(at[0], at[1], at[2], low, per_part, point)) continue;
    ++inside;
    const math::HalfCellPoint half = math::half_cell_point(point);
    const uint32_t reported[3] = {half.xy & 0xFFFFu, half.xy >> 16, half.z};
    for (int k = 0; k < 3; ++k) {
      const float off =
          static_cast<float>(static_cast<int16_t>(reported[k])) - (2.0f * cells[k] - 32768.0f);
      if (!(__builtin_fabsf(off) <= 1.012f)) ++far;
    }
  }
  CHECK_LT(19000u, inside);
  CHECK_EQ(far, 0u);
}
