#pragma once
#include <stdint.h>

#include "firmtouch/device/stored_linkage.hpp"

// Second encoders of a linkage's joints, compared with the first ones in each tick: an encoder that
// stands, slips, is swapped or counts back makes them differ.
namespace firmtouch::device {

/// As an asset stores them, behind the linkage and its homing.
using SecondEncoders = FurtherPart<SecondEncodersLayout>;
template <>
core::Verdict SecondEncoders::check(core::Bytes section, const StoredLinkage& linkage) const;

/// What the first encoder of each joint counted where both are taken to agree, and how far the
/// second has turned since.
struct SecondState {
  bool is_aligned = false;
  int32_t first[kMaxJoints] = {};
  int32_t turned[kMaxJoints] = {};
  uint8_t second[kMaxJoints] = {};  // low byte of the last count
};

/// From this sample on the encoders are compared. `second`: low byte of each second count, that of
/// joint 0 in bits 0 to 7.
void align(SecondState& state, const Sample& sample, uint32_t second);

/// Whether no joint's two encoders have turned by more than `within_rad` differently since align().
/// Once a tick: a second encoder is followed up to 127 counts from call to call, and faster
/// differs.
/// Pre: second.is_open(), state.is_aligned. Bounds: constant; re-entrant.
/// Error: 3 counts of the second encoder and one of the first, which within_rad exceeds (R718).
bool agree(SecondState& state, const SecondEncoders& second, const StoredLinkage& linkage,
           const Sample& sample, uint32_t second_counts);

}  // namespace firmtouch::device
