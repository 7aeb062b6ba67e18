#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/params/entry.hpp"

// Parameters kept in two flash sectors (A/B). Each holds slots, programmed one behind the other and
// never twice. The newest valid slot counts. Only a sector without it is erased, at start-up. So a
// power cut at any moment leaves the old parameters or the new ones.
namespace firmtouch::params {

/// One slot. A flash word has up to 32 bytes.
struct Saved {
  uint32_t magic = 0;
  uint32_t crc = 0;  // CRC-32 of all that follows
  uint32_t sequence = 0;
  uint32_t reserved = 0;
  uint64_t table_hash = 0;  // of the table that wrote it
  uint64_t present = 0;     // bit n: value[n] was a row
  float value[kFirstOwn + kMaxOwn] = {};
};
static_assert(sizeof(Saved) == 288 && sizeof(Saved) % 32 == 0);

using Sectors = const core::Bytes (&)[2];

struct SavedSlot {
  uint32_t sector = 0;
  uint32_t offset = 0;  // bytes from the sector's beginning
};

/// Result: the newest valid slot; null if there is none.
const Saved* newest_saved(Sectors sectors);

/// Result: the sector to erase before the next save can fail for lack of space; 2: neither.
uint32_t sector_to_erase(Sectors sectors);

/// Finds the slot for the next save.
/// Result: false if there is none until a sector is erased.
bool next_slot(Sectors sectors, SavedSlot& slot);

/// Fills `to` with all rows of the table. `last`: the newest slot, or null.
void save_into(Saved& to, const Saved* last, Table table, const Values& values);

/// The next row at or behind `row` whose saved value differs from the initial one. Rows of your own
/// parts count only if the same table wrote them (`table_hash`, which is too slow for a tick).
/// Result: the table's size if there is none.
uint32_t next_saved(const Saved& saved, Table table, bool is_same_table, uint32_t row,
                    float& value);

}  // namespace firmtouch::params
