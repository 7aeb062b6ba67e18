#include <stddef.h>
#include <stdint.h>

// The four functions that a freestanding compiler may call by itself. They copy words
// if both ends are aligned, else bytes; the firmware copies only small structs.

namespace {

using Word = uint32_t __attribute__((__may_alias__));

bool aligned(const void* a, const void* b) {
  return ((reinterpret_cast<uintptr_t>(a) | reinterpret_cast<uintptr_t>(b)) & 3u) == 0;
}

Word& word(void* at) { return *static_cast<Word*>(at); }
Word word(const void* at) { return *static_cast<const Word*>(at); }

}  // namespace

extern "C" {

void* memcpy(void* __restrict to, const void* __restrict from, size_t count) {
  uint8_t* out = static_cast<uint8_t*>(to);
  const uint8_t* in = static_cast<const uint8_t*>(from);
  if (aligned(to, from)) {
    for (; count >= 4; count -= 4, out += 4, in += 4) word(out) = word(in);
  }
  for (; count != 0; --count) *out++ = *in++;
  return to;
}

void* memmove(void* to, const void* from, size_t count) {
  uint8_t* out = static_cast<uint8_t*>(to);
  const uint8_t* in = static_cast<const uint8_t*>(from);
  if (reinterpret_cast<uintptr_t>(out) - reinterpret_cast<uintptr_t>(in) >= count) {
    for (; count != 0; --count) *out++ = *in++;  // never overwrites a byte that is still unread
  } else {
    while (count != 0) --count, out[count] = in[count];
  }
  return to;
}

void* memset(void* to, int value, size_t count) {
  uint8_t* out = static_cast<uint8_t*>(to);
  const uint32_t byte = static_cast<uint32_t>(value) & 0xFFu;
  if (aligned(to, nullptr)) {
    const uint32_t four = byte * 0x01010101u;
    for (; count >= 16; count -= 16, out += 16)
      word(out) = word(out + 4) = word(out + 8) = word(out + 12) = four;
    for (; count >= 4; count -= 4, out += 4) word(out) = four;
  }
  for (; count != 0; --count) *out++ = static_cast<uint8_t>(byte);
  return to;
}

int memcmp(const void* left, const void* right, size_t count) {
  const uint8_t* a = static_cast<const uint8_t*>(left);
  const uint8_t* b = static_cast<const uint8_t*>(right);
  for (; count != 0; --count, ++a, ++b) {
    if (*a != *b) return *a < *b ? -1 : 1;
  }
  return 0;
}

}  // extern "C"
