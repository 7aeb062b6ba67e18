#include "firmtouch/hal/asset_slots.hpp"

#include "map_file.hpp"
#include "options.hpp"
#include "parts/memory_flash.hpp"

// The file of `--slots` stands for flash. It is sparse.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kSlot_bytes = 64u << 20;

uint8_t* slot_at(uint32_t slot) {
  static uint8_t* const slots = map_file(options().slots, 2 * kSlot_bytes);
  return slots == nullptr ? nullptr : slots + slot * kSlot_bytes;
}

}  // namespace

AssetSlots board_asset_slots() {
  if (slot_at(0) == nullptr) return {};
  return {{{slot_at(0), kSlot_bytes}, {slot_at(1), kSlot_bytes}}, kSector_bytes};
}

bool board_erase_asset(uint32_t slot, uint32_t offset) {
  return erase_sector(slot_at(slot) + offset);
}

bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  return program_bytes(slot_at(slot) + offset, bytes);
}

}  // namespace firmtouch::hal
