#include "firmtouch/hal/asset_slots.hpp"
#include "firmtouch/hal/board.hpp"

extern "C" {
extern uint8_t __firmtouch_asset_slot[], __firmtouch_asset_slot_end[];
}

// Both halves of the memory of assets stand for flash. They keep their bytes over a reset, not
// without power.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kSector_bytes = 4096;

uint32_t slot_bytes() {
  const uintptr_t all = reinterpret_cast<uintptr_t>(__firmtouch_asset_slot_end) -
                        reinterpret_cast<uintptr_t>(__firmtouch_asset_slot);
  return static_cast<uint32_t>(all / 2 / kSector_bytes * kSector_bytes);
}

uint8_t* slot_at(uint32_t slot) { return __firmtouch_asset_slot + slot * slot_bytes(); }

}  // namespace

AssetSlots board_asset_slots() {
  const uint32_t bytes = slot_bytes();
  return {{{slot_at(0), bytes}, {slot_at(1), bytes}}, kSector_bytes};
}

bool board_erase_asset(uint32_t slot, uint32_t offset) {
  __builtin_memset(slot_at(slot) + offset, 0xFF, kSector_bytes);
  return true;
}

bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  uint8_t* const to = slot_at(slot) + offset;
  for (uint32_t i = 0; i < bytes.size(); ++i) to[i] = static_cast<uint8_t>(to[i] & bytes[i]);
  return true;
}

}  // namespace firmtouch::hal
