#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// Assets that a host loads, in two slots of flash (A/B). An asset lies at the beginning of its
// slot, and a mark at the slot's end makes it count. The mark is programmed last, once the asset
// was proven where it lies, and erased first. So a power cut at any moment leaves the old asset or
// the new one.
namespace firmtouch::asset {

/// One flash word has up to 32 bytes.
struct SlotMark {
  uint32_t magic = 0;
  uint32_t crc = 0;  // CRC-32 of all that follows
  uint32_t sequence = 0;
  uint32_t bytes = 0;      // of the asset
  uint32_t asset_crc = 0;  // Container::crc()
  uint32_t reserved[3] = {};
};
static_assert(sizeof(SlotMark) == 32);

using Slots = const core::Bytes (&)[2];

/// The asset of a slot, if its mark is whole and names it. Loading proves its other bytes.
/// Result: empty if there is none.
core::Bytes asset_in(core::Bytes slot);

/// Result: the slot whose mark is the newest; 2: neither has one.
uint32_t newest_slot(Slots slots);

/// The mark that makes the asset at the beginning of a slot the newest.
/// Pre: stated_bytes(asset) == asset.size().
SlotMark next_mark(Slots slots, core::Bytes asset);

}  // namespace firmtouch::asset
