#pragma once
#include <stdint.h>

// Which samples count as bad, and the arithmetic of counts. For .cpp files of this module alone.
namespace firmtouch::device {

// A time step outside of this is a broken clock, which servo faults; here it must only not break
// the arithmetic.
constexpr float kMinStep_s = 1e-6f;
constexpr float kMaxStep_s = 1.0f;

static inline float clamp(float value, float low, float high) {
  if (!(value >= low)) return low;  // NaN too
  return value > high ? high : value;
}

static inline int32_t difference(int32_t to, int32_t from) {
  return static_cast<int32_t>(static_cast<uint32_t>(to) - static_cast<uint32_t>(from));
}

static inline uint32_t count_bits(uint32_t word) {
  uint32_t count = 0;
  for (; word != 0; word &= word - 1) ++count;
  return count;
}

}  // namespace firmtouch::device
