#include "firmtouch/hal/asset_slots.hpp"
#include "firmtouch/hal/board.hpp"
#include "parts/memory_flash.hpp"

extern "C" {
extern uint8_t __firmtouch_asset_slot[], __firmtouch_asset_slot_end[];
}

// Both halves of the memory of assets stand for flash. They keep their bytes over a reset, not
// without power.
namespace firmtouch::hal {
namespace {

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
  return erase_sector(slot_at(slot) + offset);
}

bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  return program_bytes(slot_at(slot) + offset, bytes);
}

}  // namespace firmtouch::hal
