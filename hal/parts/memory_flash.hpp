#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// Memory that stands for flash: erasing sets all bits of a sector, programming only clears bits.
namespace firmtouch::hal {

constexpr uint32_t kSector_bytes = 4096;

inline bool erase_sector(uint8_t* sector) {
  __builtin_memset(sector, 0xFF, kSector_bytes);
  return true;
}

inline bool program_bytes(uint8_t* to, core::Bytes bytes) {
  for (uint32_t i = 0; i < bytes.size(); ++i) to[i] = static_cast<uint8_t>(to[i] & bytes[i]);
  return true;
}

}  // namespace firmtouch::hal
