#include "firmtouch/core/crc32.hpp"

namespace firmtouch::core {
namespace {

// One entry per nibble: 64 bytes of flash instead of 1 KiB, at half the speed.
constexpr uint32_t kNibble[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu,
                                  0x76DC4190u, 0x6B6B51F4u, 0x4DB26158u, 0x5005713Cu,
                                  0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                  0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};

uint32_t word_at(const uint8_t* at) {
  uint32_t word;
  __builtin_memcpy(&word, at, sizeof word);
  return word;
}

constexpr uint32_t kBlockWords = 10, kBlockBytes = 4 * kBlockWords;
constexpr uint32_t kDueWords = 10, kDueBytes = 4 * kDueWords;

// Replaces each bit of a block by four later ones: the polynomial divides x^300 + x^155 + x^117 +
// x^89 + 1, so a bit equals those 145, 183, 211 and 300 bits behind it. `due`: what is to be added
// to each of the next ten words. Five words at once take 15 % longer and 168 bytes less; twenty
// take 9 % less time and 396 bytes more.
// Source: Russell 2024, Chorba.
void replace_block(const uint8_t* at, uint32_t (&due)[kDueWords]) {
  uint32_t all[kDueWords + kBlockWords];
#pragma GCC unroll 10
  for (uint32_t i = 0; i < kDueWords; ++i) all[i] = due[i];
#pragma GCC unroll 10
  for (uint32_t i = 0; i < kBlockWords; ++i) {
    const uint32_t word = word_at(at + 4 * i) ^ all[i];
    all[i + 4] ^= word << 17;
    all[i + 5] ^= word >> 15 ^ word << 23;
    all[i + 6] ^= word >> 9 ^ word << 19;
    all[i + 7] ^= word >> 13;
    all[i + 9] ^= word << 12;
    all[i + 10] = word >> 20;
  }
#pragma GCC unroll 10
  for (uint32_t i = 0; i < kDueWords; ++i) due[i] = all[i + kBlockWords];
}

uint32_t continued(uint32_t crc, uint32_t next) {
  crc ^= next;
  crc = kNibble[crc & 15u] ^ (crc >> 4);
  return kNibble[crc & 15u] ^ (crc >> 4);
}

}  // namespace

uint32_t crc32(Bytes bytes, uint32_t crc) {
  const uint8_t* at = bytes.data();
  uint32_t left = bytes.size(), due[kDueWords] = {~crc};
  for (; left >= kBlockBytes + kDueBytes; left -= kBlockBytes, at += kBlockBytes)
    replace_block(at, due);
  const uint8_t* const end = at + left;
  const uint32_t* next = due;
  crc = 0;
  do {
    if (next != due + kDueWords) crc ^= *next++;
    for (uint32_t i = 0; i < 4 && at != end; ++i) crc = continued(crc, *at++);
  } while (at != end);
  return ~crc;
}

}  // namespace firmtouch::core
