#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::core {

/// FNV-1a, 64 bits, of a sequence of words. Compares results between machines; not for security.
class Hash {
 public:
  void add(uint32_t word) {
    for (uint32_t k = 0; k < 4; ++k, word >>= 8)
      value_ = (value_ ^ (word & 0xFFu)) * 0x100000001B3ull;
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xCBF29CE484222325ull;
};

}  // namespace firmtouch::core
