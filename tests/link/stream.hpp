#pragma once
#include <stdint.h>

#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/frame.hpp"

namespace firmtouch::link::test {

/// xorshift32: the same sequence on every machine.
class Random {
 public:
  explicit Random(uint32_t seed) : state_(seed * 2654435761u + 1u) {}
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  uint32_t below(uint32_t end) { return next() % end; }

 private:
  uint32_t state_;
};

/// Bytes as they travel.
struct Wire {
  static constexpr uint32_t kBytes = 4 * kMaxFrameBytes;
  uint8_t bytes[kBytes] = {};
  uint32_t count = 0;

  void byte(uint8_t value) { bytes[count++] = value; }
  uint32_t frame(uint8_t type, uint16_t sequence, core::Bytes payload) {
    const uint32_t added = encode(type, sequence, payload, {bytes + count, kBytes - count});
    count += added;
    return added;
  }
};

/// Feeds `wire` byte by byte. `each(frame)` for every frame found. Result: how many.
template <class Each>
uint32_t feed(Decoder& decoder, core::Bytes wire, Each each) {
  uint32_t found = 0;
  for (const uint8_t byte : wire) {
    decoder.push(byte);
    Frame frame;
    while (decoder.next(frame)) {
      ++found;
      each(frame);
    }
  }
  return found;
}

inline bool same(core::Bytes a, core::Bytes b) {
  if (a.size() != b.size()) return false;
  for (uint32_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i]) return false;
  }
  return true;
}

}  // namespace firmtouch::link::test
