#include "firmtouch/hal/parameters.hpp"

#include "firmtouch/hal/board.hpp"

extern "C" {
extern uint8_t __parameter_sectors[];  // link.ld
}

// For a board without flash of its own: two sectors of RAM stand for it. They keep their bytes over
// a reset, not without power.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kSector_bytes = 4096;

uint8_t* sector_at(uint32_t sector) { return __parameter_sectors + sector * kSector_bytes; }

}  // namespace

ParameterFlash board_parameters() {
  return {{{sector_at(0), kSector_bytes}, {sector_at(1), kSector_bytes}}};
}

bool board_erase_parameters(uint32_t sector) {
  __builtin_memset(sector_at(sector), 0xFF, kSector_bytes);
  return true;
}

bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  uint8_t* const to = sector_at(sector) + offset;
  for (uint32_t i = 0; i < bytes.size(); ++i) to[i] = static_cast<uint8_t>(to[i] & bytes[i]);
  return true;
}

}  // namespace firmtouch::hal
