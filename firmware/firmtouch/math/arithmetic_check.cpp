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

}  // namespace

bool arithmetic_is_sound() {
  return rounds_to_nearest_even() && keeps_denormals() && has_no_extra_precision() &&
         does_not_contract() && is(square_root(run_time(0x40000000u)), 0x3FB504F3u);
}

}  // namespace firmtouch::math
