#pragma once
#include <stdint.h>

#include "firmtouch/math/isa.hpp"

// Sine and cosine together, inline, of angles as joints have them. For the library's own
// translation units.
namespace firmtouch::math {

struct SineCosine {
  float sine, cosine;
};

constexpr float kMaxJointAngle_rad = 100.0f;

/// Within 1.2e-7 of both to 100 rad either way; beyond, and of NaN, as of 0.
/// The reduction takes off whole quarters by three parts of pi / 2 (Cody & Waite); the first two
/// have 8 and 11 bits, so that their products with up to 64 quarters are exact. sine() and cosine()
/// reduce every float to all its digits, for twice the instructions. The polynomials are theirs.
/// Bounds: about 55 instructions.
static inline SineCosine sine_cosine(float angle_rad) {
  if (!(__builtin_fabsf(angle_rad) <= kMaxJointAngle_rad)) angle_rad = 0.0f;
  // Adding 1.5 * 2^23 rounds to a whole number, whose last bits are then the mantissa's.
  const float shifted = angle_rad * 0.636619772f + 0x1.8p23f;
  const uint32_t quarter = bits_of(shifted);
  const float whole = shifted - 0x1.8p23f;
  const float r =
      ((angle_rad - whole * 1.5703125f) - whole * 4.83751297e-4f) - whole * 7.54978995e-8f;
  const float z = r * r;
  const float p = ((2.86567956e-6f * z - 1.98559923e-4f) * z + 8.33338592e-3f) * z - 1.66666672e-1f;
  const float q = ((2.44677067e-5f * z - 1.38877297e-3f) * z + 4.16666567e-2f) * z;
  const float s = r + (r * z) * p, c = 1.0f + (q - 0.5f) * z;
  const bool is_odd = (quarter & 1u) != 0;
  const float sine = is_odd ? c : s, cosine = is_odd ? s : c;
  return {(quarter & 2u) != 0 ? -sine : sine, ((quarter + 1u) & 2u) != 0 ? -cosine : cosine};
}

}  // namespace firmtouch::math
