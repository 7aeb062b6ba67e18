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

math::SegmentSlabs random_slabs() {
  constexpr float kRates[] = {1e-6f, 3e-5f, 1e-3f, 0.25f, 1e30f, 1e-20f};
  math::SegmentSlabs slabs;
  for (uint32_t k = 0; k < 3; ++k) {
    const bool turned = (next_random() & 1u) != 0;
    const float from = (unit() * 1.25f - 0.125f) * 32768.0f;
    const float slack = 0.015625f;
    slabs.turn[k] = turned ? 16u : 0u;
    slabs.enter[k] = turned ? 32767.0f - (from - slack) : from + slack;
    slabs.leave[k] = turned ? from + slack : 32767.0f - (from - slack);
    slabs.rate[k] = kRates[next_random() % 6] * (1.0f + unit());
  }
  return slabs;
}

}  // namespace

TEST(BoxesEnteredByASegmentAreThePortableOnesToTheBit) {
  uint32_t differ = 0, entered = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const math::SegmentSlabs slabs = random_slabs();
    const float limit = i % 3 == 0 ? 1.0f : unit();
    math::SlabLanes lanes(slabs);
    lanes.set_limit(limit);
    uint32_t boxes[8];  // the fourth and the eighth word: any
    for (uint32_t& word : boxes) {
      const uint32_t low = next_random() & 0x7FFFu, high = next_random() & 0x7FFFu;
      word = (low < high ? low : high) | (32767u - (low < high ? high : low)) << 16;
      if (i % 4 == 0) word = 0;  // all of the grid
    }
    float expected[2], told[2];
    const uint32_t mask = math::portable_entered(slabs, boxes, limit, expected);
    if (lanes.entered(boxes, told) != mask) ++differ;
    for (uint32_t box = 0; box < 2; ++box)
      if (math::bits_of(expected[box]) != math::bits_of(told[box])) ++differ;
    entered += mask != 0 ? 1u : 0u;
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(2000u, entered);
  CHECK_LT(entered, 18000u);  // both answers were seen
}
