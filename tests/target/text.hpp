#pragma once
#include <stdint.h>

// Integers as text, without a C library.
namespace firmtouch::target {

struct Text {
  char text[24] = {};
};

inline Text decimal(uint64_t value) {
  Text digits, text;
  uint32_t count = 0;
  do {
    digits.text[count++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  for (uint32_t i = 0; i < count; ++i) text.text[i] = digits.text[count - 1 - i];
  return text;
}

inline Text hexadecimal(uint64_t value) {
  Text text;
  for (uint32_t i = 0; i < 16; ++i, value <<= 4) text.text[i] = "0123456789abcdef"[value >> 60];
  return text;
}

}  // namespace firmtouch::target
