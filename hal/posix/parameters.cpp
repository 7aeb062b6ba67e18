#include "firmtouch/hal/parameters.hpp"

#include "map_file.hpp"
#include "options.hpp"
#include "parts/memory_flash.hpp"

// The file of `--parameters`, two sectors long, stands for flash.
namespace firmtouch::hal {
namespace {

uint8_t* sector_at(uint32_t sector) {
  static uint8_t* const sectors = map_file(options().parameters, 2 * kSector_bytes);
  return sectors == nullptr ? nullptr : sectors + sector * kSector_bytes;
}

}  // namespace

ParameterFlash board_parameters() {
  if (sector_at(0) == nullptr) return {};
  return {{{sector_at(0), kSector_bytes}, {sector_at(1), kSector_bytes}}};
}

bool board_erase_parameters(uint32_t sector) { return erase_sector(sector_at(sector)); }

bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  return program_bytes(sector_at(sector) + offset, bytes);
}

}  // namespace firmtouch::hal
