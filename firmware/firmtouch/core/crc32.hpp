#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::core {

/// CRC-32 (ISO-HDLC, reflected 0xEDB88320, as zip and Ethernet) of `bytes`, continued from `crc`
/// (0 for the first bytes). Detects every burst of up to 32 bits.
/// Bounds: two table look-ups a byte, 64 B of table; re-entrant.
uint32_t crc32(Bytes bytes, uint32_t crc = 0);

/// The same for long sequences, by bytes: at half the cost of a byte.
/// Bounds: 1 KiB, made when constructed in some 2,600 instructions of a Cortex-M7; then 4 a byte.
class LongCrc32 {
 public:
  LongCrc32();
  uint32_t operator()(Bytes bytes, uint32_t crc = 0) const {
    return ~continued(~crc, bytes.data(), bytes.data() + bytes.size());
  }

 private:
  uint32_t continued(uint32_t crc, const uint8_t* at, const uint8_t* end) const;
  uint32_t of_byte_[256];
};

}  // namespace firmtouch::core
