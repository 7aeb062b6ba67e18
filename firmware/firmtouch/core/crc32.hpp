#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::core {

/// CRC-32 (ISO-HDLC, reflected 0xEDB88320, as zip and Ethernet) of `bytes`, continued from `crc`
/// (0 for the first bytes). Detects every burst of up to 32 bits.
/// Bounds: about 4 instructions of a Cortex-M7 a byte, 18 instructions for each of the last 40 to
/// 79; 64 B of table; re-entrant.
uint32_t crc32(Bytes bytes, uint32_t crc = 0);

}  // namespace firmtouch::core
