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

bool rounds_to_nearest_even() {
  const float half_ulp = run_time(0x33800000u);  // 2^-24
  const float three_quarters = run_time(0x33C00000u);
  return is(run_time(kOne) + half_ulp, kOne) && is(run_time(kOne + 1) + half_ulp, kOne + 2) &&
         is(-run_time(kOne) - half_ulp, kOne | 0x80000000u) &&
         is(-run_time(kOne + 1) - half_ulp, (kOne + 2) | 0x80000000u) &&
         is(run_time(kOne) + three_quarters, kOne + 1);
}

bool keeps_denormals() {
  const float least = run_time(1u);
  const float half = run_time(0x3F000000u);
  return is(least + least, 2u) && is(run_time(0x00800000u) * half, 0x00400000u) &&
         is(run_time(0x00400000u) * run_time(0x40000000u), 0x00800000u) && !(least <= 0.0f);
}

bool has_no_extra_precision() {
  const float doubled = run_time(0x7F7FFFFFu) * run_time(0x40000000u);
  return is(doubled * run_time(0x3F000000u), 0x7F800000u);
}

// (1 + 2^-12)^2 ends in 2^-24, which a rounded product loses and a fused one keeps.
bool does_not_contract() {
  const float a = run_time(0x3F800800u);
  const float square = run_time(0x3F801000u);
  return is(a * a - square, 0u);
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
         is(run_time(0x80000000u) + 0.0f, 0u);
}

}  // namespace

bool arithmetic_is_sound() {
  return rounds_to_nearest_even() && keeps_denormals() && has_no_extra_precision() &&
         does_not_contract() && refuses_nan() && does_as_written() &&
         is(square_root(run_time(0x40000000u)), 0x3FB504F3u);
}

}  // namespace firmtouch::math
