// The elementary functions against the C library's in double, over every exponent and at the hard
// places.
#include "firmtouch/math/elementary.hpp"

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "firmtouch/math/sine_cosine.hpp"
#include "harness/float_bits.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;

namespace {

using firmtouch::test::bits_of;
using firmtouch::test::float_of;

// Distance from the truth in units in the last place of the float nearest to the truth.
double error_ulp(float got, double truth) {
  const double size = std::fabs(truth);
  if (size < static_cast<double>(FLT_MIN))
    return std::fabs(static_cast<double>(got) - truth) / 0x1p-149;
  return std::fabs(static_cast<double>(got) - truth) / std::ldexp(1.0, std::ilogb(size) - 23);
}

// Every float whose bits are start + k stride, both signs: a prime stride meets every exponent and
// mantissa pattern.
template <class Function, class Truth>
double worst_ulp(uint32_t last_bits, uint32_t stride, Function function, Truth truth) {
  double worst = 0;
  for (uint64_t bits = 0; bits <= last_bits; bits += stride) {
    const float x = float_of(static_cast<uint32_t>(bits));
    worst = std::fmax(worst, error_ulp(function(x), truth(static_cast<double>(x))));
    worst = std::fmax(worst, error_ulp(function(-x), truth(-static_cast<double>(x))));
  }
  return worst;
}

double sin_of(double x) { return std::sin(x); }
double cos_of(double x) { return std::cos(x); }

struct Random {
  uint64_t state = 88172645463325252ull;
  uint32_t next() {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<uint32_t>(state >> 16);
  }
};

}  // namespace

TEST(SineIsWithin1point5UlpOverEveryFloat) {
  CHECK_LE(worst_ulp(bits_of(FLT_MAX), 1009, math::sine, sin_of), 1.5);
}

TEST(CosineIsWithin1point5UlpOverEveryFloat) {
  CHECK_LE(worst_ulp(bits_of(FLT_MAX), 1009, math::cosine, cos_of), 1.5);
}

TEST(SineCosine_EveryAngleTo100Rad_IsWithin1point2EMinus7) {
  double worst = 0;
  for (uint32_t bits = 0; bits <= bits_of(100.0f); bits += 211) {
    for (const float x : {float_of(bits), -float_of(bits)}) {
      const math::SineCosine both = math::sine_cosine(x);
      worst = std::fmax(worst, std::fabs(static_cast<double>(both.sine) - sin_of(x)));
      worst = std::fmax(worst, std::fabs(static_cast<double>(both.cosine) - cos_of(x)));
    }
  }
  CHECK_LE(worst, 1.2e-7);
}

TEST(SineCosine_BeyondItsRangeAndNan_IsOfZero) {
  for (const float x : {100.1f, -1e9f, FLT_MAX, INFINITY, -INFINITY, NAN}) {
    CHECK_EQ(math::sine_cosine(x).sine, 0.0f);
    CHECK_EQ(math::sine_cosine(x).cosine, 1.0f);
  }
}

TEST(SineAndCosineHoldNextToEveryQuarterTurn) {
  double worst = 0;
  for (int k = 1; k < 100000; ++k) {
    const float near = static_cast<float>(k * 1.5707963267948966);
    for (int step = -2; step <= 2; ++step) {
      const float x = float_of(bits_of(near) + static_cast<uint32_t>(step));
      worst = std::fmax(worst, error_ulp(math::sine(x), std::sin(static_cast<double>(x))));
      worst = std::fmax(worst, error_ulp(math::cosine(x), std::cos(static_cast<double>(x))));
    }
  }
  CHECK_LE(worst, 1.5);
}

TEST(SineHoldsWhereAFloatComesNearestToAQuarterTurn) {
  // 16367173 * 2^72: the float nearest to a multiple of pi / 2 (Muller, Elementary Functions,
  // table 11.1).
  const float x = std::ldexp(16367173.0f, 72);
  CHECK_LE(error_ulp(math::sine(x), std::sin(static_cast<double>(x))), 1.5);
  CHECK_LE(error_ulp(math::cosine(x), std::cos(static_cast<double>(x))), 1.5);
}

TEST(SineNeverLeavesOne) {
  bool inside = true;
  for (uint64_t bits = 0; bits < 0x7F800000u; bits += 997) {
    const float x = float_of(static_cast<uint32_t>(bits));
    inside = inside && std::fabs(math::sine(x)) <= 1.0f && std::fabs(math::cosine(x)) <= 1.0f;
  }
  CHECK(inside);
}

TEST(ArcTangentIsWithin3UlpOverTheWholePlane) {
  Random random;
  double worst = 0;
  for (int i = 0; i < 2000000; ++i) {
    float y = float_of(random.next()), x = float_of(random.next());
    if (i % 2 == 0) {  // of like size, where the two branches meet
      y = float_of(0x3F000000u + (random.next() >> 8));
      x = float_of((0x3F000000u + (random.next() >> 8)) | (random.next() & 0x80000000u));
    }
    if (!std::isfinite(y) || !std::isfinite(x)) continue;
    const double truth = std::atan2(static_cast<double>(y), static_cast<double>(x));
    worst = std::fmax(worst, error_ulp(math::arc_tangent2(y, x), truth));
  }
  CHECK_LE(worst, 3.0);
}

TEST(ArcTangentHoldsAtZeroesInfinitiesAndLimits) {
  const float inf = std::numeric_limits<float>::infinity();
  const float values[] = {0.0f,     -0.0f,        1.0f, -1.0f, FLT_MIN, FLT_MAX,
                          -FLT_MAX, FLT_TRUE_MIN, inf,  -inf,  -2e38f};
  for (const float y : values) {
    for (const float x : values) {
      const double truth = std::atan2(static_cast<double>(y), static_cast<double>(x));
      const float got = math::arc_tangent2(y, x);
      CHECK_LE(error_ulp(got, truth), 3.0);
      CHECK_EQ(std::signbit(got), std::signbit(truth));
    }
  }
}

TEST(ArcCosineIsWithin1point5UlpOverItsRange) {
  CHECK_LE(worst_ulp(bits_of(1.0f), 499, math::arc_cosine, [](double x) { return std::acos(x); }),
           1.5);
  double worst = 0;  // every float next to the ends and to the seams
  for (const float seam : {1.0f, 0.5f}) {
    for (uint32_t k = 0; k < 200000; ++k) {
      const float x = float_of(bits_of(seam) - k), up = float_of(bits_of(0.5f) + k);
      for (const float v : {x, -x, up, -up}) {
        worst = std::fmax(worst, error_ulp(math::arc_cosine(v), std::acos(static_cast<double>(v))));
      }
    }
  }
  CHECK_LE(worst, 1.5);
}

TEST(Decay_IsTheExponentialFunctionTo4e6) {
  double worst = 0;
  for (uint32_t k = 0; k < bits_of(16.0f); k += 997) {
    const double exact = std::exp(-static_cast<double>(float_of(k)));
    worst = std::fmax(worst, std::fabs(static_cast<double>(math::decay(float_of(k))) - exact));
  }
  CHECK_LE(worst, 4e-6);
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK_EQ(math::decay(0.0f), 1.0f);
  CHECK_EQ(math::decay(-1.0f), 0.0f);
  CHECK_EQ(math::decay(-infinity), 0.0f);
  CHECK_EQ(math::decay(infinity), 0.0f);
  CHECK_EQ(math::decay(std::numeric_limits<float>::quiet_NaN()), 0.0f);
}
