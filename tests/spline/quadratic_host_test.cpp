// What an expansion of half the squared distance proves over a rectangle, against quartics sampled
// in double.
#include <algorithm>
#include <cmath>

#include "firmtouch/spline/surface/quadratic.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using spline::Quadratic;
using spline::Rectangle;
using tools::Random;

float within(Random& random, double most) {
  return static_cast<float>(random.between(-most, most));
}

// A quartic about `at`: its derivatives are those of the expansion, the fourth ones anything within
// its bounds.
struct Quartic {
  Quadratic f;
  double fourth[5];

  double squared(double u, double v) const {
    const auto wide = [](float x) { return static_cast<double>(x); };
    const double quadratic =
        wide(f.slope[0]) * u + wide(f.slope[1]) * v +
        0.5 * (wide(f.bend[0]) * u * u + 2 * wide(f.bend[1]) * u * v + wide(f.bend[2]) * v * v);
    const double cubic = (wide(f.third[0]) * u * u * u + 3 * wide(f.third[1]) * u * u * v +
                          3 * wide(f.third[2]) * u * v * v + wide(f.third[3]) * v * v * v) /
                         6;
    const double quartic =
        (fourth[0] * u * u * u * u + 4 * fourth[1] * u * u * u * v + 6 * fourth[2] * u * u * v * v +
         4 * fourth[3] * u * v * v * v + fourth[4] * v * v * v * v) /
        24;
    return wide(f.distance2) + 2 * (quadratic + cubic + quartic);
  }
};

// Valleys and slopes of all sizes, steep beside flat.
Quartic some_quartic(Random& random) {
  const auto size = [&](double min_exponent) { return std::exp2(random.between(min_exponent, 0)); };
  Quartic q{};
  Quadratic& f = q.f;
  f.distance2 = 4.0f;
  f.at[0] = within(random, 0.5);
  f.at[1] = within(random, 0.5);
  for (float& slope : f.slope) slope = random.below(4) == 0 ? 0.0f : within(random, size(-20));
  f.bend[0] = within(random, size(-12));
  f.bend[2] = within(random, size(-12));
  if (random.below(2) == 0) f.bend[0] = std::fabs(f.bend[0]), f.bend[2] = std::fabs(f.bend[2]);
  f.bend[1] = within(random, 2 * std::sqrt(std::fabs(static_cast<double>(f.bend[0] * f.bend[2]))));
  for (uint32_t k = 0; k < 3; ++k) f.gauss[k] = f.bend[k] + (k != 1 ? 1.0f : 0.0f);
  for (float& third : f.third) third = random.below(3) == 0 ? 0.0f : within(random, size(-10));
  for (uint32_t k = 0; k < 5; ++k) {
    f.fourth[k] = random.below(3) == 0 ? 0.0f : static_cast<float>(size(-10));
    q.fourth[k] = static_cast<double>(f.fourth[k]) * random.between(-1, k % 2 == 0 ? 3 : 1);
    if (random.below(2) == 0)
      q.fourth[k] = static_cast<double>(q.fourth[k] < 0 ? -f.fourth[k] : f.fourth[k]);
  }
  return q;
}

// About the point, beside it, or with the point on or next to a side.
Rectangle some_rectangle(Random& random, const Quadratic& f) {
  Rectangle r{};
  for (uint32_t k = 0; k < 2; ++k) {
    const auto wide = static_cast<float>(std::exp2(random.between(-8, 0)));
    const float below = random.below(3) == 0   ? 0.0f
                        : random.below(2) == 0 ? wide * 0x1p-7f
                                               : wide * static_cast<float>(random.uniform());
    r.low[k] = f.at[k] - below;
    r.high[k] = r.low[k] + wide;
    if (random.below(2) == 0) {
      const float low = r.low[k];
      r.low[k] = 2.0f * f.at[k] - r.high[k];
      r.high[k] = 2.0f * f.at[k] - low;
    }
    r.start[k] = Quadratic::clamped(f.at[k], r, k);
  }
  return r;
}

}  // namespace

TEST(NoQuarticIsLowerThanItsExpansionProves) {
  Random random(1);
  constexpr int kSides = 12;
  size_t proven_at_point = 0;
  for (int turn = 0; turn < 30000; ++turn) {
    const Quartic q = some_quartic(random);
    const Rectangle r = some_rectangle(random, q.f);
    const double bound = static_cast<double>(q.f.least2(r));
    double least = 1e300;
    const auto at = [&](double x, double y) {
      least = std::min(
          least, q.squared(x - static_cast<double>(q.f.at[0]), y - static_cast<double>(q.f.at[1])));
    };
    const auto between = [&](uint32_t k, double share) {
      return static_cast<double>(r.low[k]) +
             share * (static_cast<double>(r.high[k]) - static_cast<double>(r.low[k]));
    };
    for (int i = 0; i <= kSides; ++i)
      for (int j = 0; j <= kSides; ++j)
        at(between(0, static_cast<double>(i) / kSides),
           between(1, static_cast<double>(j) / kSides));
    at(static_cast<double>(r.start[0]), static_cast<double>(r.start[1]));
    for (uint32_t k = 0; k < 2; ++k)  // along the valley
      for (int i = 0; i <= kSides; ++i) {
        const uint32_t o = 1 - k;
        const double along = between(k, static_cast<double>(i) / kSides);
        const double tilt =
            q.f.bend[2 * o] > 0.0f ? static_cast<double>(-q.f.bend[1] / q.f.bend[2 * o]) : 0;
        const double beside =
            static_cast<double>(q.f.at[o]) + tilt * (along - static_cast<double>(q.f.at[k]));
        const double within = std::min(std::max(beside, between(o, 0)), between(o, 1));
        at(k == 0 ? along : within, k == 0 ? within : along);
      }
    // What float32 loses of the sum: a few units of its terms.
    if (!(bound <= least + 0x1p-21 * (4 + std::fabs(bound)))) {
      CHECK_LE(bound, least);
      return;
    }
    proven_at_point += bound > 4.0 - 1e-5;
  }
  CHECK(proven_at_point > 500);  // it is no trivial bound
}

// Valleys askew, level or nearly so, along which only third and fourth derivatives lead up or down.
TEST(NoValleyAskewIsLowerThanItsExpansionProves) {
  Random random(3);
  constexpr int kSteps = 64;
  size_t proven = 0, tight = 0;
  for (int turn = 0; turn < 20000; ++turn) {
    Quartic q{};
    Quadratic& f = q.f;
    f.distance2 = 4.0f;
    const double tilt = random.between(0.3, 3) * (random.below(2) == 0 ? -1 : 1);
    const double strong = std::exp2(random.between(-2, 2));
    const double level = random.below(2) == 0 ? 0 : std::exp2(random.between(-12, -6));
    const uint32_t k = random.below(2), o = 1 - k;  // the valley is y = tilt x of these axes
    f.bend[2 * o] = static_cast<float>(strong);
    f.bend[1] = static_cast<float>(-tilt * strong);
    f.bend[2 * k] = static_cast<float>(tilt * tilt * strong + level);
    if (random.below(2) == 0)
      for (float& slope : f.slope) slope = within(random, std::exp2(random.between(-8, 0)));
    const double third = std::exp2(random.between(-12, -3)),
                 fourth = std::exp2(random.between(-12, -3));
    for (float& each : f.third) each = random.below(3) == 0 ? 0.0f : within(random, third);
    for (uint32_t i = 0; i < 5; ++i) {
      f.fourth[i] = random.below(3) == 0 ? 0.0f : static_cast<float>(fourth * random.uniform());
      const bool leads_up = i % 2 == 1 && tilt > 0 ? random.below(4) == 0 : i % 2 == 1;
      q.fourth[i] = static_cast<double>(leads_up ? f.fourth[i] : -f.fourth[i]);
    }
    Rectangle r{};
    const double wide = std::exp2(random.between(-4, 0));
    r.high[k] = static_cast<float>(wide * random.uniform());
    r.low[k] = random.below(2) == 0 ? 0.0f : static_cast<float>(-wide * random.uniform());
    r.high[o] = static_cast<float>(wide * random.between(0, 4));
    r.low[o] = static_cast<float>(-wide * random.between(0, 4));
    const double bound = static_cast<double>(f.least2(r));
    double least = 4;
    for (int i = 0; i <= kSteps; ++i) {
      const double low = static_cast<double>(r.low[k]), high = static_cast<double>(r.high[k]);
      const double x = low + (high - low) * i / kSteps;
      for (const double beside : {-9.0, -0.02, -0.005, 0.0, 0.005, 0.02, 9.0}) {
        const double y = std::min(std::max(tilt * x + beside * wide, static_cast<double>(r.low[o])),
                                  static_cast<double>(r.high[o]));
        least = std::min(least, k == 0 ? q.squared(x, y) : q.squared(y, x));
      }
    }
    if (!(bound <= least + 0x1p-21 * (4 + std::fabs(bound)))) {
      CHECK_LE(bound, least);
      return;
    }
    proven += bound > 4.0 - 1e-4;
    tight += least < 4.0 - 1e-4 && bound > 4.0 - 2 * (4.0 - least);
  }
  CHECK(proven > 500);
  CHECK(tight > 500);
}

TEST(TheNextPointIsWithinAndNotWorseByTheModel) {
  Random random(2);
  for (int turn = 0; turn < 20000; ++turn) {
    const Quartic q = some_quartic(random);
    const Rectangle r = some_rectangle(random, q.f);
    float to[2];
    const float gain = q.f.next(r, to);
    for (uint32_t k = 0; k < 2; ++k) CHECK(to[k] >= r.low[k] && to[k] <= r.high[k]);
    CHECK(gain >= -0x1p-20f);
  }
}
