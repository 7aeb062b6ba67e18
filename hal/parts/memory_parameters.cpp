#include "firmtouch/hal/parameters.hpp"

#include "firmtouch/hal/board.hpp"
#include "parts/memory_flash.hpp"

extern "C" {
extern uint8_t __parameter_sectors[];  // link.ld
}

// For a board without flash of its own: two sectors of RAM stand for it. They keep their bytes over
// a reset, not without power.
namespace firmtouch::hal {
namespace {

uint8_t* sector_at(uint32_t sector) { return __parameter_sectors + sector * kSector_bytes; }

}  // namespace

ParameterFlash board_parameters() {
  return {{{sector_at(0), kSector_bytes}, {sector_at(1), kSector_bytes}}};
}

bool board_erase_parameters(uint32_t sector) { return erase_sector(sector_at(sector)); }

bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  return program_bytes(sector_at(sector) + offset, bytes);
}

}  // namespace firmtouch::hal
