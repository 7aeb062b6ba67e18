#pragma once
#include "firmtouch/core/span.hpp"

// Two slots of flash for assets that a host loads (asset/slots.hpp), read in place. Only programs
// with part `asset_slots` link these functions.
namespace firmtouch::hal {

struct AssetSlots {
  core::Bytes slot[2];  // 32-byte aligned, of one size, a multiple of the sector's
  uint32_t sector_bytes = 0;
};

/// Result: empty slots if this board has none.
/// Context: start-up, main loop.
AssetSlots board_asset_slots();

/// Erases the sector that begins at `offset` to 0xFF. Where the processor or a tick would read this
/// flash meanwhile, it holds interrupts off and feeds the watchdog by itself.
/// Result: false on failure.
/// Context: main loop, motors off and held off.
bool board_erase_asset(uint32_t slot, uint32_t offset);

/// Programs erased bytes. As above.
/// Pre: `offset` and the size are multiples of 32.
/// Result: false on failure; the caller compares what it reads.
/// Context: main loop, motors off and held off.
bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes);

}  // namespace firmtouch::hal
