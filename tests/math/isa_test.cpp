// The instruction-set variants give the bits of their portable definitions, and elementary
// functions are total.
#include "firmtouch/math/isa.hpp"

#include <float.h>
#include <stdint.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/arithmetic_check.hpp"
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;

namespace {

firmtouch::test::Xorshift next_random(1);

bool is_nan(float value) { return (math::bits_of(value) & 0x7FFFFFFFu) > 0x7F800000u; }

// Both square roots of a value read at run time: bits equal, or both NaN (whose payload is nobody's
// business).
bool roots_agree(uint32_t bits) {
  volatile uint32_t word = bits;
  const float value = math::float_of(word);
  const float portable = math::portable::square_root(value), variant = math::square_root(value);
  return math::bits_of(portable) == math::bits_of(variant) || (is_nan(portable) && is_nan(variant));
}

constexpr uint32_t kSpecials[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x80000001u, 0x007FFFFFu,
                                  0x00800000u, 0x807FFFFFu, 0x3F7FFFFFu, 0x3F800000u, 0x3F800001u,
                                  0xBF800000u, 0x7F7FFFFFu, 0xFF7FFFFFu, 0x7F800000u, 0xFF800000u,
                                  0x7FC00000u, 0xFFC00000u, 0x7F800001u, 0x3FC90FDBu, 0x40490FDBu};

}  // namespace

TEST(Ranges_OfAnyBits_AreThoseOfComparisons) {
  const float limits[] = {0.0f, 1e-9f, 1.0f, 1e4f, FLT_MAX};
  firmtouch::test::Xorshift random(2);
  uint32_t differing = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const uint32_t bits = i < sizeof kSpecials / 4 ? kSpecials[i] : random();
    const float a = math::float_of(bits);
    for (const float most : limits) {
      differing += math::is_up_to(a, most) != (a >= 0.0f && a <= most);
      differing += math::is_within(a, most) != (a >= -most && a <= most);
    }
  }
  CHECK_EQ(differing, 0u);
}

TEST(PortableSquareRootHasTheBitsOfTheProcessors) {
  for (const uint32_t bits : kSpecials) CHECK(roots_agree(bits));
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 40000; ++i) differ += roots_agree(i * 107377u) ? 0u : 1u;  // all over
  for (uint32_t i = 0; i < 4000; ++i)
    differ += roots_agree(next_random() & 0x7FFFFFu) ? 0u : 1u;  // denormals
  for (uint32_t i = 0; i < 4000; ++i)
    differ += roots_agree(0x3F800000u + i) ? 0u : 1u;  // next to 1
  for (uint32_t i = 1; i < 4000; ++i) {  // next to exact squares, where rounding turns
    const float square = static_cast<float>(i) * static_cast<float>(i);
    for (uint32_t k = 0; k < 3; ++k) differ += roots_agree(math::bits_of(square) + k - 1) ? 0u : 1u;
  }
  CHECK_EQ(differ, 0u);
}

// Exact in integers: two significands of 24 bits, and 48 bits of product.
TEST(ProductError_IsWhatRoundingLost) {
  uint32_t wrong = 0, differ = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const uint32_t m = 0x800000u | (next_random() & 0x7FFFFFu);
    const uint32_t n = 0x800000u | (next_random() & 0x7FFFFFu);
    const float a = static_cast<float>(m),
                b = (i & 1u) != 0 ? -static_cast<float>(n) : static_cast<float>(n);
    volatile float rounded = a * b;
    const float product = rounded, error = math::product_error(a, b, product);
    const int64_t exact = (i & 1u) != 0 ? -(int64_t{m} * n) : int64_t{m} * n;
    wrong += static_cast<int64_t>(product) + static_cast<int64_t>(error) == exact ? 0u : 1u;
    // Scaled to where the error is a denormal, and below where it counts as 0.
    constexpr float kScales[] = {0x1p-60f, 0x1p-72f, 0x1p-74f, 0x1p40f};
    for (const float scale : kScales) {
      const float x = a * scale, y = b * scale;
      volatile float small = x * y;
      differ += math::bits_of(math::product_error(x, y, small)) ==
                        math::bits_of(math::portable::product_error(x, y, small))
                    ? 0u
                    : 1u;
    }
  }
  CHECK_EQ(wrong, 0u);
  CHECK_EQ(differ, 0u);
}

TEST(PortableSquareRootIsTheNearestFloat) {
  // r is right where (r - half ulp)^2 < x < (r + half ulp)^2, in integers: r = 2^12 scaled, x = r^2
  // scaled.
  uint32_t wrong = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const uint32_t mantissa = 0x800000u | (next_random() & 0x7FFFFFu);
    const float x = math::float_of(0x4B000000u | (mantissa & 0x7FFFFFu));  // the integer `mantissa`
    const uint32_t root = math::bits_of(math::portable::square_root(x));
    // 2^11.5 <= root < 2^12: exponent 138, 12 bits behind the point; doubled for the half bit.
    const uint64_t twice = 2 * static_cast<uint64_t>((root & 0x7FFFFFu) | 0x800000u);
    const uint64_t target = static_cast<uint64_t>(mantissa) << 26;
    if ((root >> 23) != 138u) ++wrong;
    if (!((twice - 1) * (twice - 1) < target && target < (twice + 1) * (twice + 1))) ++wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(CountDown_ReturnsWhetherNotZero) {
  uint32_t count = 3;
  CHECK(math::count_down(count));
  CHECK_EQ(count, 2u);
  CHECK(math::count_down(count));
  CHECK(!math::count_down(count));
  CHECK_EQ(count, 0u);
  CHECK(math::count_down(count));
  CHECK_EQ(count, UINT32_MAX);
}

TEST(NextOfTakesOneAfterTheOther) {
  const uint16_t shorts[] = {65535, 1, 40000};
  const uint32_t words[] = {UINT32_MAX, 7, 0x80000001u};
  const uint16_t* at_short = shorts;
  const uint32_t* at_word = words;
  for (uint32_t k = 0; k < 3; ++k) {
    CHECK_EQ(math::next_of(at_short), shorts[k]);
    CHECK_EQ(math::next_of(at_word), words[k]);
  }
  CHECK(at_short == shorts + 3);
  CHECK(at_word == words + 3);
}

TEST(BoxDistanceVariantsAgree) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    uint32_t boxes[8], point[3];  // two boxes and what lies behind them
    boxes[6] = next_random(), boxes[7] = next_random();
    for (int k = 0; k < 6; ++k) {
      const uint32_t low = next_random() & 0x7FFFu, high = next_random() & 0x7FFFu;
      boxes[k] = (low < high ? low : high) | (32767u - (low < high ? high : low)) << 16;
      if (i % 16 == 0) boxes[k] = (i & 16u) != 0 ? 32767u : 32767u << 16;
    }
    for (int k = 0; k < 3; ++k) {
      const uint32_t ceil = next_random() & 0x7FFFu,
                     floor = ceil == 0 ? 0 : ceil - (next_random() & 1u);
      point[k] = ceil | (32767u - floor) << 16;
      if (i % 16 == 0) point[k] = (i & 32u) != 0 ? 32767u : 32767u << 16;
    }
    const math::BoxPoint packed = math::box_point(point[0], point[1], point[2]);
    const uint32_t first = math::portable::box_distance2(boxes, point),
                   second = math::portable::box_distance2(boxes + 3, point);
    if (math::box_distance2(boxes, packed) != first) ++differ;
    if (math::box_distance2(boxes + 3, packed) != second) ++differ;
    // As a node holds them: each with a word behind it.
    const uint32_t sides[8] = {boxes[0], boxes[1], boxes[2], next_random(),
                               boxes[3], boxes[4], boxes[5], next_random()};
    uint32_t reported_first, reported_second, word0, word1;
    math::side_distances2(sides, packed, reported_first, reported_second, word0, word1);
    if (reported_first != first || reported_second != second) ++differ;
    if (word0 != sides[3] || word1 != sides[7]) ++differ;
  }
  CHECK_EQ(differ, 0u);
}

TEST(BoxDistanceIsTheSquaredGapInCells) {
  const uint32_t box[4] = {100u | (32767u - 200u) << 16, 100u | (32767u - 200u) << 16,
                           0u | 0u << 16, 0xFFFFFFFFu};
  const math::BoxPoint inside = math::box_point(
      150u | (32767u - 150u) << 16, 100u | (32767u - 100u) << 16, 7u | (32767u - 7u) << 16);
  const math::BoxPoint beside = math::box_point(
      90u | (32767u - 90u) << 16, 203u | (32767u - 203u) << 16, 7u | (32767u - 7u) << 16);
  CHECK_EQ(math::box_distance2(box, inside), 0u);
  CHECK_EQ(math::box_distance2(box, beside), 100u + 9u);
}

TEST(FloatsBeyondAWordAreSaturated) {
  CHECK_EQ(math::portable::saturated(3.99f), 3u);
  CHECK_EQ(math::portable::saturated(-0.5f), 0u);
  CHECK_EQ(math::portable::saturated(-1e30f), 0u);
  CHECK_EQ(math::portable::saturated(4294967040.0f), 4294967040u);  // the last float below 2^32
  CHECK_EQ(math::portable::saturated(0x1p32f), UINT32_MAX);
  CHECK_EQ(math::portable::saturated(math::float_of(0x7F800000u)), UINT32_MAX);
  CHECK_EQ(math::portable::saturated(math::float_of(0x7FC00000u)), 0u);
  CHECK_EQ(math::portable::saturated(math::float_of(0xFF800001u)), 0u);
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const float value = math::float_of(next_random());
    if (math::saturated(value) != math::portable::saturated(value)) ++differ;
  }
  CHECK_EQ(differ, 0u);
}

TEST(PointsOnTheGridAreTheSameEverywhere) {
  uint32_t differ = 0, inside = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const float low[4] = {-1.0f, 2.0f, 0.25f, 7.0f};
    float at[3];
    for (uint32_t k = 0; k < 3; ++k) {  // 16 cells to a unit; 2,048 units, their ends, and any bits
      const float share = static_cast<float>(next_random() >> 8) * 0x1p-24f;
      at[k] = low[k] + share * (i % 4 == 1 ? 2049.0f : 2047.0f);
      if (i % 4 == 2) at[k] = low[k] + (k == i % 3 ? share * 0x1p-10f : 2047.9f + 0.2f * share);
      if (i % 8 == 7 && k == i % 3) at[k] = math::float_of(next_random());
    }
    math::BoxPoint reported;
    math::portable::BoxPoint expected;
    const bool is_inside = math::grid_point(at[0], at[1], at[2], low, 0x1p20f, reported);
    if (is_inside != math::portable::grid_point(at[0], at[1], at[2], low, 0x1p20f, expected))
      ++differ;
    if (!is_inside) continue;
    ++inside;
    if (__builtin_memcmp(&reported, &expected, sizeof expected) != 0) ++differ;
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(8000u, inside);
  CHECK_LT(inside, 16000u);
}

TEST(TheLargerAndTheSmallerOfTwoHaveTheSameBitsEverywhere) {
  const float infinite = math::float_of(0x7F800000u), none = math::float_of(0x7FC00000u);
  const float edges[] = {0.0f,       -0.0f,    1.0f,      -1.0f, 0x1p-149f,
                         -0x1p-149f, infinite, -infinite, none};
  const float limits[] = {0.0f, 1.0f, -1.0f, 0x1p-149f, infinite, -infinite};
  uint32_t differ = 0;
  const auto compare = [&differ](float value, float limit) {
    const uint32_t larger = math::bits_of(math::portable::larger(value, limit));
    const uint32_t smaller = math::bits_of(math::portable::smaller(value, limit));
    if (math::bits_of(math::larger(value, limit)) != larger) ++differ;
    const bool has_smaller = limit < 0.0f || limit > 0.0f;
    if (has_smaller && math::bits_of(math::smaller(value, limit)) != smaller) ++differ;
  };
  for (const float limit : limits) {
    for (const float edge : edges) compare(edge, limit);
    for (uint32_t i = 0; i < 5000; ++i) {
      const float value = math::float_of(next_random());
      if (value - value <= 0.0f) compare(value, limit);
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_EQ(math::bits_of(math::larger(-2.0f, -1.0f)), math::bits_of(-1.0f));
  CHECK_EQ(math::bits_of(math::smaller(-2.0f, -1.0f)), math::bits_of(-2.0f));
  CHECK_EQ(math::bits_of(math::larger(none, 3.0f)), math::bits_of(3.0f));
  CHECK_EQ(math::bits_of(math::smaller(none, 3.0f)), math::bits_of(3.0f));
}

TEST(FloatsLoadedTogetherAreThoseOfTheirPlaces) {
  float values[9];
  for (int k = 0; k < 9; ++k) values[k] = static_cast<float>(k + 1);
  const uint32_t stride = math::as_multiplier(3);
  CHECK_EQ(stride, 3u);
  float a[3], b[3], c[3];
  math::load_floats<0>(values + 2 * stride, a[0], a[1], a[2]);
  math::load_floats<1>(values + 0 * stride, b[0], b[1], b[2]);
  math::load_floats<2>(values + 1 * stride, c[0], c[1], c[2]);
  for (int k = 0; k < 3; ++k) {
    CHECK_EQ(a[k], values[6 + k]);
    CHECK_EQ(b[k], values[k]);
    CHECK_EQ(c[k], values[3 + k]);
  }
}

TEST(ThisProcessorComputesAsTheBakersDid) { CHECK(math::arithmetic_is_sound()); }

// Every check of the firmware is of these forms; -ffinite-math-only would make them pass a NaN.
TEST(NanIsInsideNoLimit) {
  const uint32_t nans[] = {0x7FC00000u, 0xFFC00000u, 0x7F800001u, 0xFFFFFFFFu};
  for (const uint32_t bits : nans) {
    volatile uint32_t word = bits;
    const float nan = math::float_of(word);
    const bool above = !(nan <= FLT_MAX), below = !(nan >= -FLT_MAX);
    CHECK(above && below);
    CHECK(!math::is_finite(nan));
    CHECK(!math::is_finite(math::Vec3{0, nan, 0}));
  }
  volatile float largest = FLT_MAX;
  CHECK(math::is_finite(largest));
}

TEST(ElementaryFunctionsAreFiniteForEveryInput) {
  const auto is_finite = [](float value) {
    return (math::bits_of(value) & 0x7FFFFFFFu) < 0x7F800000u;
  };
  for (const uint32_t bits : kSpecials) {
    const float x = math::float_of(bits);
    CHECK(is_finite(math::sine(x)));
    CHECK(is_finite(math::cosine(x)));
    CHECK(is_finite(math::arc_cosine(x)));
    CHECK(is_finite(math::safe_square_root(x)));
    for (const uint32_t other : kSpecials)
      CHECK(is_finite(math::arc_tangent2(x, math::float_of(other))));
  }
  const float nan = math::float_of(0x7FC00000u), inf = math::float_of(0x7F800000u);
  CHECK_EQ(math::sine(nan), 0.0f);
  CHECK_EQ(math::cosine(inf), 1.0f);
  CHECK_EQ(math::arc_tangent2(nan, 1.0f), 0.0f);
  CHECK_EQ(math::arc_cosine(2.0f), 0.0f);
  CHECK_EQ(math::arc_cosine(-2.0f), 3.14159274f);
  CHECK_EQ(math::arc_cosine(nan), 1.57079637f);
  CHECK_EQ(math::safe_square_root(-1.0f), 0.0f);
  CHECK_EQ(math::safe_square_root(inf), FLT_MAX);
}

// The same number on every compiler, level and controller: it was computed once on x86-64, and no
// target may differ.
TEST(ElementaryFunctionsHaveOneHashEverywhere) {
  firmtouch::core::Hash hash;
  for (uint32_t i = 0; i < 8000; ++i) {
    const float x = math::float_of(i * 268435u), y = math::float_of(0x3F000000u + i * 4099u);
    hash.add(math::bits_of(math::sine(x)));
    hash.add(math::bits_of(math::cosine(-x)));
    hash.add(math::bits_of(math::arc_tangent2(x, y)));
    hash.add(math::bits_of(math::arc_tangent2(y, -y * 0.75f)));
    hash.add(math::bits_of(math::arc_cosine(2.0f * y - 2.0f)));
    hash.add(math::bits_of(math::safe_square_root(x)));
  }
  CHECK_EQ(static_cast<uint32_t>(hash.value()), 1842873646u);
}
