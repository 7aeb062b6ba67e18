#include "firmtouch/params/saved.hpp"

#include <stddef.h>

#include "firmtouch/core/crc32.hpp"

namespace firmtouch::params {
namespace {

constexpr uint32_t kMagic = 0x31505446;  // FTP1
constexpr uint32_t kBytes = sizeof(Saved);

uint32_t crc_of(const Saved& saved) {
  const auto* const bytes = reinterpret_cast<const uint8_t*>(&saved);
  constexpr uint32_t kHead = offsetof(Saved, sequence);
  return core::crc32({bytes + kHead, kBytes - kHead});
}

const Saved& slot_at(core::Bytes sector, uint32_t offset) {
  return *static_cast<const Saved*>(static_cast<const void*>(sector.data() + offset));
}

bool is_valid(const Saved& saved) { return saved.magic == kMagic && saved.crc == crc_of(saved); }

bool is_blank(core::Bytes bytes) {
  for (const uint8_t byte : bytes)
    if (byte != 0xFF) return false;
  return true;
}

// Where the newest slot is. Result: false if there is none.
bool find_newest(Sectors sectors, SavedSlot& found) {
  const Saved* best = nullptr;
  for (uint32_t s = 0; s < 2; ++s) {
    for (uint32_t at = 0; at + kBytes <= sectors[s].size(); at += kBytes) {
      const Saved& slot = slot_at(sectors[s], at);
      if (!is_valid(slot)) continue;
      // The difference modulo 2^32: the counter may wrap.
      if (best != nullptr && static_cast<int32_t>(slot.sequence - best->sequence) <= 0) continue;
      best = &slot;
      found = {s, at};
    }
  }
  return best != nullptr;
}

bool blank_slot(core::Bytes sector, uint32_t& at) {
  for (; at + kBytes <= sector.size(); at += kBytes)
    if (is_blank({sector.data() + at, kBytes})) return true;
  return false;
}

}  // namespace

const Saved* newest_saved(Sectors sectors) {
  SavedSlot found;
  if (!find_newest(sectors, found)) return nullptr;
  return &slot_at(sectors[found.sector], found.offset);
}

uint32_t sector_to_erase(Sectors sectors) {
  SavedSlot newest;
  const bool any = find_newest(sectors, newest);
  for (uint32_t s = 0; s < 2; ++s)
    if (!(any && newest.sector == s) && !is_blank(sectors[s])) return s;
  return 2;
}

bool next_slot(Sectors sectors, SavedSlot& slot) {
  SavedSlot newest;
  const bool any = find_newest(sectors, newest);
  slot = {newest.sector, any ? newest.offset + kBytes : 0};
  if (blank_slot(sectors[slot.sector], slot.offset)) return true;
  slot = {1 - slot.sector, 0};
  return blank_slot(sectors[slot.sector], slot.offset);
}

void save_into(Saved& to, const Saved* last, Table table, const Values& values) {
  const uint32_t sequence = last == nullptr ? 0 : last->sequence + 1;
  to = {};
  to.magic = kMagic;
  to.sequence = sequence;
  to.table_hash = table_hash(table);
  for (const Entry& entry : table) {
    to.present |= uint64_t{1} << entry.number;
    to.value[entry.number] = values[entry.number];
  }
  to.crc = crc_of(to);
}

uint32_t next_saved(const Saved& saved, Table table, bool is_same_table, uint32_t row,
                    float& value) {
  for (; row < table.size(); ++row) {
    const Entry& entry = table[row];
    if ((saved.present >> entry.number & 1) == 0) continue;
    if (entry.number >= kFirstOwn && !is_same_table) continue;
    value = saved.value[entry.number];
    if (value < entry.initial || value > entry.initial) break;
  }
  return row;
}

}  // namespace firmtouch::params
