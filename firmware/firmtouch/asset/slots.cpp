#include "firmtouch/asset/slots.hpp"

#include <stddef.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/crc32.hpp"

namespace firmtouch::asset {
namespace {

constexpr uint32_t kMarkMagic = 0x31415446;  // FTA1
constexpr uint32_t kBytes = sizeof(SlotMark);

uint32_t crc_of(const SlotMark& mark) {
  constexpr uint32_t kHead = offsetof(SlotMark, sequence);
  return core::crc32({reinterpret_cast<const uint8_t*>(&mark) + kHead, kBytes - kHead});
}

uint32_t header_crc(core::Bytes asset) { return core::as_array<Header>(asset, 1)[0].header_crc; }

// Null if it is not whole, or names another asset than the one in its slot.
const SlotMark* mark_of(core::Bytes slot) {
  if (slot.size() < kBytes + sizeof(Header)) return nullptr;
  const SlotMark& mark = core::as_array<SlotMark>({slot.end() - kBytes, kBytes}, 1)[0];
  const bool is_whole = mark.magic == kMarkMagic && mark.crc == crc_of(mark);
  if (!is_whole || mark.bytes > slot.size() - kBytes || mark.bytes < sizeof(Header)) return nullptr;
  const core::Bytes asset = {slot.data(), mark.bytes};
  return stated_bytes(asset) == mark.bytes && header_crc(asset) == mark.asset_crc ? &mark : nullptr;
}

}  // namespace

core::Bytes asset_in(core::Bytes slot) {
  const SlotMark* const mark = mark_of(slot);
  return mark == nullptr ? core::Bytes{} : core::Bytes{slot.data(), mark->bytes};
}

uint32_t newest_slot(Slots slots) {
  const SlotMark* const a = mark_of(slots[0]);
  const SlotMark* const b = mark_of(slots[1]);
  if (a == nullptr) return b == nullptr ? 2 : 1;
  // The difference modulo 2^32: the counter may wrap.
  return b != nullptr && static_cast<int32_t>(b->sequence - a->sequence) > 0 ? 1 : 0;
}

SlotMark next_mark(Slots slots, core::Bytes asset) {
  SlotMark mark;
  const uint32_t newest = newest_slot(slots);
  mark.magic = kMarkMagic;
  mark.sequence = newest > 1 ? 0 : mark_of(slots[newest])->sequence + 1;
  mark.bytes = asset.size();
  mark.asset_crc = header_crc(asset);
  mark.crc = crc_of(mark);
  return mark;
}

}  // namespace firmtouch::asset
