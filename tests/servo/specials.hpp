#pragma once
#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"

// Hostile input values, and checks of forces in double, by their exact values.
namespace firmtouch::test {

constexpr uint32_t kSpecialBits[] = {
    0x00000000u, 0x80000000u, 0x00000001u, 0x80000001u, 0x007FFFFFu, 0x00800000u, 0x322BCC77u,
    0x3F800000u, 0xBF800000u, 0x3F7FFFFFu, 0x461C4000u, 0xC61C4001u, 0x49742400u, 0x5F000000u,
    0x7F7FFFFFu, 0xFF7FFFFFu, 0x7F800000u, 0xFF800000u, 0x7FC00000u, 0xFFC00001u, 0x7F800001u};

inline double square(float a) { return static_cast<double>(a) * static_cast<double>(a); }
inline double square(math::Vec3 a) { return square(a.x) + square(a.y) + square(a.z); }
inline double square_of_change(math::Vec3 a, math::Vec3 b) {
  const double x = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double y = static_cast<double>(a.y) - static_cast<double>(b.y);
  const double z = static_cast<double>(a.z) - static_cast<double>(b.z);
  return x * x + y * y + z * z;
}
inline bool is_number(float a) { return (math::bits_of(a) & 0x7FFFFFFFu) < 0x7F800000u; }
inline bool is_number(math::Vec3 a) { return is_number(a.x) && is_number(a.y) && is_number(a.z); }

struct Random {
  uint32_t word = 2463534242u;
  uint32_t next() {
    word ^= word << 13, word ^= word >> 17, word ^= word << 5;
    return word;
  }
  float unit() { return static_cast<float>(static_cast<int32_t>(next())) * 0x1p-31f; }  // -1 to 1
};

}  // namespace firmtouch::test
