// Four boxes at once against a segment have the bits of math::Slabs.
#include "simd/search/slabs.hpp"

#include <string.h>

#include "harness/random.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace simd = firmtouch::simd;

namespace {

firmtouch::test::Xorshift next_random(7);
float unit() { return static_cast<float>(next_random() >> 8) * 0x1p-24f; }

struct Segment {
  float a[3], b[3];
  math::Vec3 from() const { return {a[0], a[1], a[2]}; }
  math::Vec3 to() const { return {b[0], b[1], b[2]}; }
};
constexpr float kLow[3] = {-3.25f, 0.5f, 17.0f};
constexpr float kCell = 0x1p-9f;

// From inside the grid or beside it, of any length, some along an axis; every eleventh too far off
// or NaN.
Segment random_segment(uint32_t i) {
  constexpr float kLengths[] = {1e6f, 3e4f, 1e3f, 4.0f, 0.0f, 1e-31f, 1e18f};
  const float strange[] = {1e19f, -1e30f, math::float_of(0x7F800000u), math::float_of(0x7FC00000u)};
  Segment segment;
  for (uint32_t k = 0; k < 3; ++k) {
    segment.a[k] = kLow[k] + (unit() * 1.25f - 0.125f) * 32768.0f * kCell;
    segment.b[k] = segment.a[k] + (unit() - 0.5f) * kLengths[next_random() % 7] * kCell;
  }
  if (i % 11 == 0) segment.a[next_random() % 3] = strange[next_random() % 4];
  if (i % 11 == 5) segment.b[next_random() % 3] = strange[next_random() % 4];
  return segment;
}

void random_boxes(bool is_all, uint32_t (&boxes)[8]) {  // the fourth words: any
  for (uint32_t& word : boxes) {
    const uint32_t low = next_random() & 0x7FFFu, high = next_random() & 0x7FFFu;
    word = (low < high ? low : high) | (32767u - (low < high ? high : low)) << 16;
    if (is_all) word = 0;
  }
}

}  // namespace

TEST(FourBoxesAgainstASegment_HaveTheBitsOfEach) {
  uint32_t differ = 0, entered = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const Segment segment = random_segment(i);
    math::Slabs portable;
    simd::FourSlabs four;
    const bool is_near = portable.begin(math::on_grid(segment.from(), segment.to(), kLow, kCell));
    CHECK_EQ(four.begin(segment.from(), segment.to(), kLow, kCell), is_near);
    CHECK_EQ(is_near, i % 11 != 0 && i % 11 != 5);
    portable.set_limit(1.0f);
    uint32_t boxes[2][8];
    uint64_t reported[2];
    for (uint32_t(&two)[8] : boxes) random_boxes(i % 4 == 0, two);
    firmtouch::mesh::Node children[2];
    static_assert(sizeof children == sizeof boxes);
    memcpy(children, boxes, sizeof children);
    four.enter(simd::with_planes(children[0], children[1]), reported[0], reported[1]);
    for (uint32_t pair = 0; pair < 2; ++pair) {
      uint32_t expected[2];
      portable.enter(boxes[pair], expected);
      if (simd::keys_of(expected[0], expected[1]) != reported[pair]) ++differ;
      for (const uint32_t key : expected) {
        if (key != math::kNotEntered) ++entered;
        if (!is_near) CHECK_EQ(key, 0u);
      }
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(8000u, entered);
  CHECK_LT(entered, 72000u);
}

// The wide search measures each box once, with a limit of 1.
TEST(LowerLimit_OnlyRemovesBoxesEnteredLater) {
  uint32_t taken = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const Segment segment = random_segment(i);
    math::Slabs slabs;
    slabs.begin(math::on_grid(segment.from(), segment.to(), kLow, kCell));
    uint32_t boxes[8], whole[2], limited[2];
    random_boxes(i % 4 == 0, boxes);
    slabs.set_limit(1.0f);
    slabs.enter(boxes, whole);
    const float limit = unit();
    slabs.set_limit(limit);
    slabs.enter(boxes, limited);
    for (uint32_t box = 0; box < 2; ++box) {
      CHECK_EQ(limited[box], whole[box] <= math::bits_of(limit) ? whole[box] : math::kNotEntered);
      if (limited[box] != whole[box]) ++taken;
    }
  }
  CHECK_LT(50u, taken);
}
