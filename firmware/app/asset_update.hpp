#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::app {

/// The i-th asset to try at start-up: what a host has loaded, the newest first. Empty: none.
core::Bytes loaded_asset(uint32_t i);

/// Part `asset_slots`: writes an asset that a host sends into the slot that is not in use, proves
/// it there, makes it the one of the next start, and swaps to it. The motors are held off
/// meanwhile. Main loop only.
class AssetUpdate {
 public:
  /// Answers a host's frame. Result: false if it is none of an update.
  bool answer(const link::Frame& frame, bool is_lock_step, link::AssetAck& ack);
  /// Refused while the motors may push.
  link::AssetAck begin(const link::BeginAsset& wanted);
  /// Erases the sectors that the block begins, and programs it.
  link::AssetAck put(const link::AssetBlock& block);
  /// Begins the proof. Later calls return the result, kAckBusy until there is one.
  link::AssetAck commit();
  /// Refused while a tick is about to swap.
  link::AssetAck abort();
  /// A slice of the proof.
  void work();

 private:
  enum class Phase : uint8_t { kIdle, kWriting, kProving, kSwapping, kEnded };

  uint32_t reason_to_refuse(const link::BeginAsset& wanted);
  bool erase(uint32_t from, uint32_t to);
  uint32_t program(uint32_t offset, core::Bytes bytes);
  uint32_t make_newest(core::Bytes asset);
  void swap();
  link::AssetAck end(uint32_t result);

  Phase phase_ = Phase::kIdle;
  uint32_t slot_ = 0;  // that is written
  link::BeginAsset wanted_;
  uint32_t crc_ = 0;  // of what flash holds so far
  link::AssetAck last_;
};

extern AssetUpdate asset_update;

}  // namespace firmtouch::app
