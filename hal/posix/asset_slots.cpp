#include "firmtouch/hal/asset_slots.hpp"

#include <cstring>

#include "map_file.hpp"
#include "options.hpp"

// The file of `--slots` stands for flash: program only clears bits. It is sparse.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kSector_bytes = 4096, kSlot_bytes = 64u << 20;

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
  std::memset(slot_at(slot) + offset, 0xFF, kSector_bytes);
  return true;
}

bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  uint8_t* const to = slot_at(slot) + offset;
  for (uint32_t i = 0; i < bytes.size(); ++i) to[i] = static_cast<uint8_t>(to[i] & bytes[i]);
  return true;
}

}  // namespace firmtouch::hal
