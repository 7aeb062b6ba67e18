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

/// Constants of sine_cosine(). Several angles that share them load them once: 13 instructions less
/// an angle.
struct SineTerms {
  float most_rad = in_register(kMaxJointAngle_rad);
  float quarters_per_rad = in_register(0.636619772f);
  float to_whole = in_register(0x1.8p23f);
  float quarter_rad[3] = {in_register(1.5703125f), in_register(4.83751297e-4f),
                          in_register(7.54978995e-8f)};
  float sine[4] = {in_register(2.86567956e-6f), in_register(1.98559923e-4f),
                   in_register(8.33338592e-3f), in_register(1.66666672e-1f)};
  float cosine[3] = {in_register(2.44677067e-5f), in_register(1.38877297e-3f),
                     in_register(4.16666567e-2f)};
  float half = in_register(0.5f), one = in_register(1.0f);
};

/// Within 1.2e-7 of both to 100 rad either way; beyond, and of NaN, as of 0.
/// The reduction takes off whole quarters by three parts of pi / 2 (Cody & Waite); the first two
/// have 8 and 11 bits, so that their products with up to 64 quarters are exact. sine() and cosine()
/// reduce every float to all its digits, for twice the instructions. The polynomials are theirs.
/// Bounds: about 75 instructions, 55 instructions where the terms are loaded already.
static inline SineCosine sine_cosine(float angle_rad, const SineTerms& terms = {}) {
  if (!(__builtin_fabsf(angle_rad) <= terms.most_rad)) angle_rad = 0.0f;
  // Adding 1.5 * 2^23 rounds to a whole number, whose last bits are then the mantissa's.
  const float shifted = angle_rad * terms.quarters_per_rad + terms.to_whole;
  const uint32_t quarter = bits_of(shifted);
  const float whole = shifted - terms.to_whole;
  const float r = ((angle_rad - whole * terms.quarter_rad[0]) - whole * terms.quarter_rad[1]) -
                  whole * terms.quarter_rad[2];
  const float z = r * r;
  const float p = ((terms.sine[0] * z - terms.sine[1]) * z + terms.sine[2]) * z - terms.sine[3];
  const float q = ((terms.cosine[0] * z - terms.cosine[1]) * z + terms.cosine[2]) * z;
  const float s = r + (r * z) * p, c = terms.one + (q - terms.half) * z;
  // The quarter about 0, where joints are most: 8 instructions less.
  if ((quarter & 3u) == 0) return {s, c};
  const bool is_odd = (quarter & 1u) != 0;
  const float sine = is_odd ? c : s, cosine = is_odd ? s : c;
  return {(quarter & 2u) != 0 ? -sine : sine, ((quarter + 1u) & 2u) != 0 ? -cosine : cosine};
}

}  // namespace firmtouch::math
