// The variants of a segment against two boxes give the bits of the portable definition.
#include "firmtouch/math/isa_segment.hpp"

#include "harness/test.hpp"

namespace math = firmtouch::math;

namespace {

uint32_t g_seed = 7;
uint32_t next_random() {
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return g_seed;
}
float unit() { return static_cast<float>(next_random() >> 8) * 0x1p-24f; }

// From inside the grid or beside it, of any length; every eleventh too far off or not a number.
math::GridSegment random_segment(uint32_t i) {
  constexpr float kLengths[] = {1e6f, 3e4f, 1e3f, 4.0f, 0.0f, 1e-31f, 1e18f};
  const float strange[] = {1e19f, -1e30f, math::float_of(0x7F800000u), math::float_of(0x7FC00000u)};
  math::GridSegment segment;
  for (uint32_t k = 0; k < 3; ++k) {
    segment.origin[k] = (unit() * 1.25f - 0.125f) * 32768.0f;
    segment.step[k] = (unit() - 0.5f) * kLengths[next_random() % 7];
  }
  if (i % 11 == 0) segment.origin[next_random() % 3] = strange[next_random() % 4];
  if (i % 11 == 5) segment.step[next_random() % 3] = strange[next_random() % 4];
  return segment;
}

}  // namespace

TEST(BoxesEnteredByASegmentAreThePortableOnesToTheBit) {
  uint32_t differ = 0, entered = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const math::GridSegment segment = random_segment(i);
    math::PortableSlabs portable;
    math::Slabs slabs;
    const bool is_near = portable.begin(segment);
    CHECK_EQ(slabs.begin(segment), is_near);
    CHECK_EQ(is_near, i % 11 != 0 && i % 11 != 5);
    const float limit = i % 3 == 0 ? 1.0f : unit();
    portable.set_limit(limit);
    slabs.set_limit(limit);
    uint32_t boxes[7];  // the fourth word: any
    for (uint32_t& word : boxes) {
      const uint32_t low = next_random() & 0x7FFFu, high = next_random() & 0x7FFFu;
      word = (low < high ? low : high) | (32767u - (low < high ? high : low)) << 16;
      if (i % 4 == 0) word = 0;  // all of the grid
    }
    uint32_t expected[2], told[2];
    portable.enter(boxes, expected);
    slabs.enter(boxes, told);
    for (uint32_t box = 0; box < 2; ++box) {
      if (expected[box] != told[box]) ++differ;
      if (expected[box] != math::kNotEntered) ++entered;
      if (!is_near) CHECK_EQ(told[box], 0u);
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(4000u, entered);
  CHECK_LT(entered, 36000u);
}
