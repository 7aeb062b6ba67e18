#include "firmtouch/hal/parameters.hpp"

#include <cstring>

#include "map_file.hpp"
#include "options.hpp"

// The file of `--parameters`, two sectors long, stands for flash: program only clears bits.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kSector_bytes = 4096;

uint8_t* sector_at(uint32_t sector) {
  static uint8_t* const sectors = map_file(options().parameters, 2 * kSector_bytes);
  return sectors == nullptr ? nullptr : sectors + sector * kSector_bytes;
}

}  // namespace

ParameterFlash board_parameters() {
  if (sector_at(0) == nullptr) return {};
  return {{{sector_at(0), kSector_bytes}, {sector_at(1), kSector_bytes}}};
}

bool board_erase_parameters(uint32_t sector) {
  std::memset(sector_at(sector), 0xFF, kSector_bytes);
  return true;
}

bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  uint8_t* const to = sector_at(sector) + offset;
  for (uint32_t i = 0; i < bytes.size(); ++i) to[i] = static_cast<uint8_t>(to[i] & bytes[i]);
  return true;
}

}  // namespace firmtouch::hal
