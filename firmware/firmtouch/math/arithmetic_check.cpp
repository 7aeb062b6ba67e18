#include "firmtouch/math/arithmetic_check.hpp"

#include <stdint.h>

#include "firmtouch/math/isa.hpp"

namespace firmtouch::math {
namespace {

// Through memory, so that the running processor computes and not the compiler.
float run_time(uint32_t bits) {
  volatile uint32_t word = bits;
  return float_of(word);
}

bool is(float value, uint32_t bits) {
  volatile float stored = value;
  return bits_of(stored) == bits;
}

constexpr uint32_t kOne = 0x3F800000u;

// a b + c, each rounded, by bits.
struct Sum {
  uint32_t a, b, c, sum;
};
constexpr uint32_t kMinus = 0x80000000u, kTwo = 0x40000000u, kHalf = 0x3F000000u;
constexpr uint32_t kHalfUlp = 0x33800000u, kThreeQuarterUlps = 0x33C00000u;  // 2^-24, 1.5 2^-24
constexpr Sum kSums[] = {
    {kOne, kHalfUlp, kOne, kOne},  // ties go to even
    {kOne, kHalfUlp, kOne + 1, kOne + 2},
    {kOne, kMinus | kHalfUlp, kMinus | kOne, kMinus | kOne},  //
    {kOne, kMinus | kHalfUlp, kMinus | (kOne + 1), kMinus | (kOne + 2)},
    {kOne, kThreeQuarterUlps, kOne, kOne + 1},             // others to the nearest
    {kOne, 1u, 1u, 2u},                                    // denormals stay
    {0x00800000u, kHalf, 0u, 0x00400000u},                 // as results
    {0x00400000u, kTwo, 0u, 0x00800000u},                  // as operands
    {0x7F7FFFFFu, kTwo, 0xFF7FFFFFu, 0x7F800000u},         // no wider exponents
    {0x3F800800u, 0x3F800800u, kMinus | 0x3F801000u, 0u},  // not fused: loses 2^-24
};

bool rounds_sums() {
  for (const Sum& sum : kSums)
    if (!is(run_time(sum.a) * run_time(sum.b) + run_time(sum.c), sum.sum)) return false;
  return !(run_time(1u) <= 0.0f);  // a denormal, compared
}

// As the checks of an asset and the guard compare: a NaN is never inside a limit.
bool is_inside(float low, float value, float high) {
  volatile bool outside = !(value >= low && value <= high);
  return !outside;
}

bool refuses_nan() {
  const float limit = run_time(0x7F7FFFFFu);
  const uint32_t outside[] = {0x7FC00000u, 0xFFC00000u, 0x7F800001u, 0x7F800000u, 0xFF800000u};
  for (const uint32_t bits : outside)
    if (is_inside(-limit, run_time(bits), limit)) return false;
  const float nan = run_time(0x7FC00000u);
  volatile bool finite = nan - nan <= 0.0f;  // as is_finite() has it
  volatile bool above = !(nan <= limit);
  volatile bool below = !(nan >= -limit);
  return !finite && above && below && is_inside(-limit, limit, limit);
}

// Sums in the order written, quotients divided, zeroes with their sign.
bool does_as_written() {
  const float one = run_time(kOne), tiny = run_time(0x33000000u);  // 2^-25
  return is((one + tiny) - one, 0u) && is(run_time(0x40A00000u) / 3.0f, 0x3FD55555u) &&
         is(run_time(kMinus) + 0.0f, 0u);
}

}  // namespace

bool arithmetic_is_sound() {
  return rounds_sums() && refuses_nan() && does_as_written() &&
         is(square_root(run_time(kTwo)), 0x3FB504F3u);
}

}  // namespace firmtouch::math
