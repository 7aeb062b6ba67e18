#pragma once
#include "firmtouch/device/stored_linkage.hpp"

// Thermal limits of a linkage's motors by I squared t: torque is proportional to current, so the
// heat is one of squares of torque.
namespace firmtouch::device {

/// As an asset stores them, behind all else of the linkage.
using Derating = FurtherPart<DeratingLayout>;
template <>
core::Verdict Derating::check(core::Bytes section, const StoredLinkage& linkage) const;

/// Heat x of each winding in units of its continuous torque's square: x' = (torque^2 - x) / T.
/// Initially that of the continuous torque: a motor may be hot after a reset.
struct HeatState {
  float heat[kMaxJoints] = {1, 1, 1};
  float below[kMaxJoints] = {};  // digits below those of `heat`
};

/// The motors had these torques for `dt_s`. Then, per joint, the most that it may have: the
/// continuous torque, and what is above it up to the largest times (1 - x) / (1/4), from 0 to 1.
/// So x does not exceed 1 with steps up to 25 ms (R720), which are also the least that the limit
/// takes from one end to the other; behind a longer step the limit is the continuous torque until x
/// is below 1 again. A joint without thermal limit keeps its largest torque.
/// Pre: derating.is_open(). Bounds: constant; re-entrant. Result: not below the continuous torque.
/// Error: x within dt_s / T of its size, with torques held during a step; roundings 4e-7.
void heat(HeatState& state, const Derating& derating, const StoredLinkage& linkage,
          const float (&torque_Nm)[kMaxJoints], float dt_s, float (&most_Nm)[kMaxJoints]);

}  // namespace firmtouch::device
