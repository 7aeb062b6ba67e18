#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Lock-free queue of received bytes: one writer (interrupt, push), one reader (main loop, pop).
class ByteRing {
 public:
  // 10 ms at 1 Mbaud, or several of the largest frames.
  static constexpr uint32_t kCapacity_bytes = 1024;

  /// Result: false if the ring is full. The byte is lost; the CRC of its frame reports that.
  bool push(uint8_t byte) {
    const uint32_t in = in_;
    if (in - out_ >= kCapacity_bytes) return false;
    bytes_[in % kCapacity_bytes] = byte;
    in_ = in + 1;
    return true;
  }
  uint32_t pop(uint8_t* to, uint32_t capacity) {
    uint32_t count = 0;
    uint32_t out = out_;
    for (; count < capacity && out != in_; ++count, ++out)
      to[count] = bytes_[out % kCapacity_bytes];
    out_ = out;
    return count;
  }
  bool empty() const { return in_ == out_; }

 private:
  // volatile: the compiler stores the byte before its index. A single core sees its own writes in
  // order.
  volatile uint8_t bytes_[kCapacity_bytes] = {};
  volatile uint32_t in_ = 0, out_ = 0;
};

}  // namespace firmtouch::hal
