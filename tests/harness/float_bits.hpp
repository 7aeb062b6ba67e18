#pragma once
#include <stdint.h>

namespace firmtouch::test {

inline float float_of(uint32_t bits) {
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}
inline uint32_t bits_of(float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline float nan_value() { return float_of(0x7FC00000); }

}  // namespace firmtouch::test
