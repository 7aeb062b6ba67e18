#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::link {

/// Writes a message into the caller's buffer; always zero-terminated, truncated if it does not fit.
class TextWriter {
 public:
  /// Pre: to.size() >= 1.
  explicit TextWriter(core::Span<char> to) : to_(to) { to_[0] = 0; }

  TextWriter& text(const char* text) {
    while (*text != 0) put(*text++);
    return *this;
  }
  TextWriter& decimal(uint32_t value) {
    char digits[10];
    uint32_t count = 0;
    do {
      digits[count++] = static_cast<char>('0' + value % 10u);
      value /= 10u;
    } while (value != 0);
    while (count > 0) put(digits[--count]);
    return *this;
  }
  /// 0x and `digits` hexadecimal digits, 8 or 16.
  TextWriter& hex(uint64_t value, uint32_t digits) {
    text("0x");
    for (uint32_t k = digits; k-- > 0;) put("0123456789abcdef"[(value >> (4 * k)) & 15u]);
    return *this;
  }
  uint32_t size() const { return count_; }

 private:
  void put(char c) {
    if (count_ + 1 >= to_.size()) return;
    to_[count_++] = c;
    to_[count_] = 0;
  }

  core::Span<char> to_;
  uint32_t count_ = 0;
};

}  // namespace firmtouch::link
