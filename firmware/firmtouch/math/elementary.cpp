#include "firmtouch/math/elementary.hpp"

#include <float.h>
#include <stdint.h>

#include "firmtouch/math/isa.hpp"

namespace firmtouch::math {
namespace {

constexpr uint32_t kSign = 0x80000000u;
constexpr uint32_t kInfinity = 0x7F800000u;
constexpr float kPi = 3.14159274f;  // rounded up by kPiOver
constexpr float kPiOver = 8.74227766e-8f;
constexpr float kHalfPi = 1.57079637f;
constexpr float kHalfPiOver = 4.37113883e-8f;

uint32_t size_bits(float value) { return bits_of(value) & ~kSign; }
float with_sign_of(float size, float sign) {
  return float_of(bits_of(size) | (bits_of(sign) & kSign));
}

// An angle as a quarter turn (0 to 3) and what is left, within an eighth of a turn either side.
struct Reduced {
  uint32_t quarter;
  float rest_rad;
};

// 2/pi, its first word after the point second: the largest float needs bits up to 2^-201 of it.
constexpr uint32_t kTwoOverPi[8] = {0,           0xA2F9836Eu, 0x4E441529u, 0xFC2757D1u,
                                    0xF534DDC0u, 0xDB629599u, 0x3C439041u, 0xFE5163ABu};

uint32_t window(uint32_t first_bit) {
  const uint32_t word = first_bit >> 5, shift = first_bit & 31u;
  const uint64_t pair = static_cast<uint64_t>(kTwoOverPi[word]) << 32 | kTwoOverPi[word + 1];
  return static_cast<uint32_t>(pair >> (32u - shift));
}

// x 2/pi modulo 4, by the 96 bits of 2/pi that matter: those above are worth whole turns, those
// below less than 2^-70. x = m 2^s with a mantissa m of 24 bits; the window's first bit is worth 2
// quarters. (Payne & Hanek 1983)
Reduced reduce(float angle_rad) {
  const uint32_t bits = size_bits(angle_rad);
  if (bits < 0x3F490FDBu) return {0, angle_rad};  // below pi / 4
  const uint64_t m = (bits & 0x7FFFFFu) | 0x800000u;
  const uint32_t first = (bits >> 23) - 150u + 30u;  // s + 30: -24 <= s <= 104
  const uint64_t low = m * window(first + 64u);
  const uint64_t middle = m * window(first + 32u) + (low >> 32);
  const uint32_t high =
      static_cast<uint32_t>(m * window(first)) + static_cast<uint32_t>(middle >> 32);
  const uint64_t turn =
      static_cast<uint64_t>(high) << 32 | static_cast<uint32_t>(middle);  // 2^62 a quarter

  const uint64_t part = turn << 2;  // of a quarter, 2^64 the whole
  const bool over = (part >> 63) != 0;
  const uint32_t quarter = static_cast<uint32_t>(turn >> 62) + (over ? 1u : 0u);
  uint64_t rest = over ? 0u - part : part;
  // The nearest that a float comes to a whole quarter leaves 2^-33 of it, so this is never 0.
  const uint32_t zeros = static_cast<uint32_t>(__builtin_clzll(rest | 1u));
  rest <<= zeros;
  const uint64_t product = (rest >> 32) * 0xC90FDAA2u;  // pi / 2 in 2^-31
  const float size = static_cast<float>(static_cast<uint32_t>(product >> 32)) *
                     float_of((127u - 31u - zeros) << 23);
  const bool negative = over != ((bits_of(angle_rad) & kSign) != 0);
  return {(bits_of(angle_rad) & kSign) != 0 ? 0u - quarter : quarter, negative ? -size : size};
}

// Minimax on [-pi/4, pi/4].
float sine_of_rest(float r) {
  const float s = r * r;
  const float p = ((2.86567956e-6f * s - 1.98559923e-4f) * s + 8.33338592e-3f) * s - 1.66666672e-1f;
  return r + (r * s) * p;
}

float cosine_of_rest(float r) {
  const float s = r * r;
  const float p = ((2.44677067e-5f * s - 1.38877297e-3f) * s + 4.16666567e-2f) * s;
  return 1.0f + (p - 0.5f) * s;
}

float of_quarter(const Reduced& reduced, uint32_t ahead) {
  const uint32_t quarter = (reduced.quarter + ahead) & 3u;
  const float value =
      (quarter & 1u) != 0 ? cosine_of_rest(reduced.rest_rad) : sine_of_rest(reduced.rest_rad);
  return (quarter & 2u) != 0 ? -value : value;
}

// On [0, tan(pi/8)]; Moshier's atanf.
float arc_tangent_of_small(float t) {
  const float z = t * t;
  const float p =
      ((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f;
  return t + (p * z) * t;
}

// On [-1/2, 1/2]; Moshier's asinf.
float arc_sine_of_small(float a) {
  const float z = a * a;
  const float p =
      (((4.2163199048e-2f * z + 2.4181311049e-2f) * z + 4.5470025998e-2f) * z + 7.4953002686e-2f) *
          z +
      1.6666752422e-1f;
  return a + (p * z) * a;
}

// Angle of (large, small), both >= 0, small <= large, large > 0: 0 to pi / 4.
float arc_tangent_of_eighth(float small, float large) {
  if (!(small > 0.41421356f * large)) return arc_tangent_of_small(small / large);
  if (large > 0x1p125f) small *= 0x1p-3f, large *= 0x1p-3f;  // their sum must not overflow
  const float t = (large - small) / (large + small);
  return 0.785398163f - arc_tangent_of_small(t);
}

}  // namespace

float sine(float angle_rad) {
  if (size_bits(angle_rad) >= kInfinity) return 0.0f;
  return of_quarter(reduce(angle_rad), 0);
}

float cosine(float angle_rad) {
  if (size_bits(angle_rad) >= kInfinity) return 1.0f;
  return of_quarter(reduce(angle_rad), 1);
}

float arc_tangent2(float y, float x) {
  const uint32_t y_bits = size_bits(y), x_bits = size_bits(x);
  if (y_bits > kInfinity || x_bits > kInfinity) return 0.0f;
  float rise = float_of(y_bits), run = float_of(x_bits);
  if (y_bits == kInfinity || x_bits == kInfinity) {
    rise = y_bits == kInfinity ? 1.0f : 0.0f;
    run = x_bits == kInfinity ? 1.0f : 0.0f;
  }
  float angle = 0.0f;
  if (rise > run) {
    angle = kHalfPi - (arc_tangent_of_eighth(run, rise) + kHalfPiOver);
  } else if (run > 0.0f) {
    angle = arc_tangent_of_eighth(rise, run);
  }
  if ((bits_of(x) & kSign) != 0) angle = kPi - (angle + kPiOver);
  return with_sign_of(angle, y);
}

float arc_cosine(float cosine) {
  if (size_bits(cosine) > kInfinity) return kHalfPi;
  if (cosine >= 1.0f) return 0.0f;
  if (cosine <= -1.0f) return kPi;
  if (cosine > 0.5f) return 2.0f * arc_sine_of_small(square_root(0.5f * (1.0f - cosine)));
  if (cosine < -0.5f) {
    return kPi - (2.0f * arc_sine_of_small(square_root(0.5f * (1.0f + cosine))) + kPiOver);
  }
  return kHalfPi - (arc_sine_of_small(cosine) + kHalfPiOver);
}

// Pade's fraction of a 32nd, squared five times.
float decay(float x) {
  if (!(x >= 0.0f && x < 16.0f)) return 0.0f;
  const float y = x * 0.03125f, half = 0.5f * y;
  const float even = 1.0f + y * y * 0.083333336f;
  float power = (even - half) / (even + half);
  for (int i = 0; i < 5; ++i) power = power * power;
  return power;
}

float safe_square_root(float value) {
  if (!(value > 0.0f)) return 0.0f;
  return value > FLT_MAX ? FLT_MAX : square_root(value);
}

}  // namespace firmtouch::math
