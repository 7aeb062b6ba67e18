#include "firmtouch/core/crc32.hpp"

namespace firmtouch::core {
namespace {

// One entry per nibble: 64 bytes of flash instead of 1 KiB, at half the speed. A tick computes
// none.
constexpr uint32_t kNibble[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu,
                                  0x76DC4190u, 0x6B6B51F4u, 0x4DB26158u, 0x5005713Cu,
                                  0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                  0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};

}  // namespace

uint32_t crc32(Bytes bytes, uint32_t crc) {
  crc = ~crc;
  const uint8_t* at = bytes.data();
  const uint8_t* const end = at + bytes.size();
  for (; end - at >= 4; at += 4) {
    uint32_t word;
    __builtin_memcpy(&word, at, sizeof word);
    crc ^= word;
    for (uint32_t pair = 0; pair < 2; ++pair) {
      crc = kNibble[crc & 15u] ^ (crc >> 4);
      crc = kNibble[crc & 15u] ^ (crc >> 4);
      crc = kNibble[crc & 15u] ^ (crc >> 4);
      crc = kNibble[crc & 15u] ^ (crc >> 4);
    }
  }
  for (; at != end; ++at) {
    crc ^= *at;
    crc = kNibble[crc & 15u] ^ (crc >> 4);
    crc = kNibble[crc & 15u] ^ (crc >> 4);
  }
  return ~crc;
}

}  // namespace firmtouch::core
