#include "asset_update.hpp"

#include "firmtouch/asset/slots.hpp"
#include "firmtouch/core/crc32.hpp"
#include "firmtouch/hal/asset_slots.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {
namespace {

constexpr uint32_t kWord_bytes = 32;  // the largest of a flash
constexpr uint32_t kMark_bytes = sizeof(asset::SlotMark);
static_assert(kMark_bytes == kWord_bytes);

bool overlap(core::Bytes a, core::Bytes b) { return a.begin() < b.end() && b.begin() < a.end(); }

// Result: 2 if the asset in use reaches into both slots.
uint32_t slot_to_write(const hal::AssetSlots& slots) {
  const core::Bytes in_use = controller.asset();
  const uint32_t newest = asset::newest_slot(slots.slot);
  const uint32_t first = overlap(in_use, slots.slot[0]) || newest == 0 ? 1 : 0;
  if (!overlap(in_use, slots.slot[first])) return first;
  return overlap(in_use, slots.slot[1 - first]) ? 2 : 1 - first;
}

bool is_equal(core::Bytes a, const uint8_t* b) {
  for (uint32_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) return false;
  return true;
}

}  // namespace

AssetUpdate asset_update;

core::Bytes loaded_asset(uint32_t i) {
  const hal::AssetSlots slots = hal::board_asset_slots();
  const uint32_t newest = asset::newest_slot(slots.slot);
  return newest > 1 ? core::Bytes{} : asset::asset_in(slots.slot[i == 0 ? newest : 1 - newest]);
}

uint32_t AssetUpdate::reason_to_refuse(const link::BeginAsset& wanted) {
  const hal::AssetSlots slots = hal::board_asset_slots();
  const bool is_opening = !controller.is_ready() && controller.verdict().ok();
  if (wanted.protocol != link::kProtocolVersion) return link::kAckOtherProtocol;
  if (slots.slot[0].empty()) return link::kAckNoFlash;
  if (is_opening || phase_ == Phase::kProving || phase_ == Phase::kSwapping) return link::kAckBusy;
  if (wanted.bytes < sizeof(asset::Header) || wanted.bytes % asset::kAlignment != 0 ||
      wanted.bytes > slots.slot[0].size() - kMark_bytes)
    return link::kAckOutOfRange;
  slot_ = slot_to_write(slots);
  if (slot_ > 1) return link::kAckAssetInTheWay;
  if (motors_may_push()) return link::kAckMotorsOn;
  hold_motors_off(true);
  return motors_may_push() ? link::kAckMotorsOn : link::kAckTaken;  // a tick may have come between
}

bool AssetUpdate::answer(const link::Frame& frame, bool is_lock_step, link::AssetAck& ack) {
  link::BeginAsset wanted;
  link::AssetBlock block;
  if (frame.type < link::kBeginAsset || frame.type > link::kAbortAsset) return false;
  if (is_lock_step) {
    ack.result = link::kAckInLockStep;
  } else if (frame.type == link::kCommitAsset) {
    ack = commit();
  } else if (frame.type == link::kAbortAsset) {
    ack = abort();
  } else if (frame.type == link::kBeginAsset && link::take(frame, wanted)) {
    ack = begin(wanted);
  } else if (frame.type == link::kAssetBlock && link::take(frame, block)) {
    ack = put(block);
  } else {
    ack.result = link::kAckOtherProtocol;  // another length
  }
  return true;
}

link::AssetAck AssetUpdate::begin(const link::BeginAsset& wanted) {
  const uint32_t reason = reason_to_refuse(wanted);
  if (reason == link::kAckBusy) return {reason};
  if (reason != link::kAckTaken) return end(reason);
  wanted_ = wanted;
  crc_ = 0;
  last_ = {};
  controller.begin_next({});  // the scene of the asset before may be of this slot
  const hal::AssetSlots slots = hal::board_asset_slots();
  const uint32_t size = slots.slot[slot_].size();
  // The mark first: from here on nothing of this slot counts.
  if (!hal::board_erase_asset(slot_, size - slots.sector_bytes)) return end(link::kAckFlashFailed);
  phase_ = Phase::kWriting;
  return last_;
}

// The sectors that begin in a range, except the mark's, which is erased already.
bool AssetUpdate::erase(uint32_t from, uint32_t to) {
  const hal::AssetSlots slots = hal::board_asset_slots();
  const uint32_t sector = slots.sector_bytes, size = slots.slot[slot_].size();
  for (uint32_t at = (from + sector - 1) / sector * sector; at < to; at += sector)
    if (at != size - sector && !hal::board_erase_asset(slot_, at)) return false;
  return true;
}

uint32_t AssetUpdate::program(uint32_t offset, core::Bytes bytes) {
  const bool is_written = hal::board_program_asset(slot_, offset, bytes);
  const uint8_t* const there = hal::board_asset_slots().slot[slot_].data() + offset;
  return is_written && is_equal(bytes, there) ? link::kAckTaken : link::kAckFlashFailed;
}

link::AssetAck AssetUpdate::put(const link::AssetBlock& block) {
  if (phase_ != Phase::kWriting) return {link::kAckNoUpdate};
  if (block.offset != last_.next || block.offset >= wanted_.bytes) return last_;
  const uint32_t left = wanted_.bytes - block.offset;
  const uint32_t count = left < link::kAssetBlockBytes ? left : link::kAssetBlockBytes;
  uint8_t words[link::kAssetBlockBytes];
  for (uint32_t i = 0; i < link::kAssetBlockBytes; ++i) words[i] = i < count ? block.data[i] : 0xFF;
  const uint32_t padded = (count + kWord_bytes - 1) / kWord_bytes * kWord_bytes;
  if (!erase(block.offset, block.offset + padded)) return end(link::kAckFlashFailed);
  const uint32_t result = program(block.offset, {words, padded});
  if (result != link::kAckTaken) return end(result);
  crc_ = core::crc32({words, count}, crc_);
  last_.next += count;
  return last_;
}

link::AssetAck AssetUpdate::commit() {
  if (phase_ == Phase::kIdle) return {link::kAckNoUpdate};
  if (phase_ == Phase::kProving || phase_ == Phase::kSwapping) return {link::kAckBusy};
  if (phase_ == Phase::kEnded) return last_;
  if (last_.next < wanted_.bytes) return {link::kAckOutOfRange, last_.next};
  if (crc_ != wanted_.crc) return end(link::kAckWrongCrc);
  controller.begin_next({hal::board_asset_slots().slot[slot_].data(), wanted_.bytes});
  phase_ = Phase::kProving;
  return {link::kAckBusy};
}

link::AssetAck AssetUpdate::abort() {
  if (phase_ == Phase::kSwapping) return {link::kAckBusy};
  end(link::kAckNoUpdate);
  return {};
}

void AssetUpdate::work() {
  if (phase_ == Phase::kSwapping &&
      overlap(controller.asset(), hal::board_asset_slots().slot[slot_]))
    end(link::kAckTaken);
  if (phase_ != Phase::kProving || !controller.work_next(kSliceUnits)) return;
  const core::Verdict verdict = controller.next_verdict();
  if (!verdict.ok()) {
    end(link::kAckAssetRejected);
    last_.rule = verdict.rule;
    last_.element = verdict.element;
    return;
  }
  const uint32_t result = make_newest({hal::board_asset_slots().slot[slot_].data(), wanted_.bytes});
  if (result != link::kAckTaken) {
    end(result);
  } else {
    swap();
  }
}

uint32_t AssetUpdate::make_newest(core::Bytes asset) {
  const hal::AssetSlots slots = hal::board_asset_slots();
  const asset::SlotMark mark = asset::next_mark(slots.slot, asset);
  return program(slots.slot[slot_].size() - kMark_bytes,
                 {reinterpret_cast<const uint8_t*>(&mark), kMark_bytes});
}

// By a tick's command if the servo runs, so that the record shows it.
void AssetUpdate::swap() {
  if (!servo_is_running()) {
    end(controller.swap() ? link::kAckTaken : link::kAckAtRestart);
  } else if (!kTwoRates && controller.can_swap() && commands.put_swap()) {
    phase_ = Phase::kSwapping;
  } else {
    end(link::kAckAtRestart);
  }
}

link::AssetAck AssetUpdate::end(uint32_t result) {
  phase_ = result == link::kAckNoUpdate ? Phase::kIdle : Phase::kEnded;
  last_ = {result};
  hold_motors_off(false);
  return last_;
}

}  // namespace firmtouch::app
