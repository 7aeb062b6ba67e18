#pragma once
#include <stdint.h>

#include "firmtouch/device/stored_homing.hpp"
#include "firmtouch/device/stored_linkage.hpp"

// Index pulses of a linkage's joints. They make homing by stops exact. After it, a pulse at another
// count, or none where one is due, says that a belt or cable has slipped.
namespace firmtouch::device {

/// As an asset stores them, behind the linkage and its homing.
using IndexPulses = FurtherPart<IndexLayout, StoredHoming>;
template <>
core::Verdict IndexPulses::check(core::Bytes section, const StoredLinkage& linkage,
                                 const StoredHoming& homing) const;

/// Homing by them. Pre: both are open.
HomingSettings settings_of(const StoredHoming& homing, const IndexPulses& index);

/// Counts are those of the encoders.
struct IndexState {
  bool is_started = false;
  bool is_off = false;                // until it is started anew
  int32_t counts[kMaxJoints] = {};    // of the last sample
  int32_t pulse[kMaxJoints] = {};     // where one stands
  int32_t interval[kMaxJoints] = {};  // n: the joint was last between pulses n and n + 1 from there
  uint32_t seen = 0;                  // bit k: joint k passed a pulse since
  uint32_t missing[kMaxJoints] = {};  // samples in another interval without one
};

/// Pulses as record::flags_of_index() packs them. Result: a bit for each joint whose pulse is
/// certain, its whole count in `latched`: faster than 127 counts from sample to sample it is not.
uint32_t pulses_of(const IndexState& state, const Sample& sample, uint32_t packed,
                   int32_t (&latched)[kMaxJoints]);

/// From this sample on pulses are to stand where homing found them, or whole periods from there.
void start(IndexState& state, const IndexPulses& index, const StoredLinkage& linkage,
           const int32_t (&pulse)[kMaxJoints], const Sample& sample);

/// Whether no pulse since start() was off by more than `within_rad`, and none was missing in the
/// third sample behind where it was due.
/// Pre: index.is_open(), state.is_started. Bounds: constant; re-entrant.
/// Error: 3 counts, which within_rad exceeds (R719). A pulse that is passed faster than 128 counts
/// from sample to sample hides a slip of nearly a multiple of 128 counts up to the next pulse.
bool follow(IndexState& state, const IndexPulses& index, const StoredLinkage& linkage,
            const Sample& sample, uint32_t packed);

/// A sample was not valid: pulses may have been lost with it.
inline void excuse(IndexState& state) { state.seen = UINT32_MAX; }

}  // namespace firmtouch::device
