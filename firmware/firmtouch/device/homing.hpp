#pragma once
#include <stdint.h>

#include "firmtouch/device/joints.hpp"

// Homing of a linkage's joints, before the controller's first tick: raw counts in, torques out, and
// at the end the offsets that make counts absolute. It is linked where it is called.
namespace firmtouch::device {

enum class HomeBy : uint32_t {
  kKnownPose,  // the joints stand at pose_rad
  kAbsolute,   // a second sensor gives the angles, roughly or exactly
  kStops,      // the middle between both end stops is that of the range
  kIndex,      // the same, then the exact angle of an index pulse
};

struct HomingSettings {
  HomeBy by = HomeBy::kStops;
  float torque_Nm[kMaxJoints] = {};  // the most that is applied: a finger stops it
  float speed_rad_per_s = 6;
  float margin_rad = 0.1f;  // by which the travel between the stops may miss the range
  float pose_rad[kMaxJoints] = {};
  float index_rad[kMaxJoints] = {};  // angle of an index pulse
  float index_period_rad[kMaxJoints] = {};
  float index_within_rad = 0;  // by which pulses may miss whole periods; at least 2 counts
};

struct HomingSample {
  Sample encoders;
  uint32_t pulses = 0;               // bit k: joint k passed an index pulse since the last sample
  int32_t latched[kMaxJoints] = {};  // its counts at this pulse
  float absolute_rad[kMaxJoints] = {};
};

enum class HomingFault : uint32_t {
  kNone,
  kSettings,     // check_homing() fails
  kBadSamples,   // three samples in a row are invalid or too far apart
  kDeadEncoder,  // the joint's counts stand while it is driven, or its angle is not in the range:
                 // its encoder or its motor is dead
  kWrongWay,     // motor or encoder of the joint is reversed
  kSwapped,      // the joint is driven, and the counts of `other` move
  kBlocked,      // the travel is shorter than the range: a finger in the way
  kNoStop,       // the travel is longer than the range
  kNoIndex,      // no pulse in the whole travel
  kWrongIndex,   // the pulses disagree with the stops or with each other
  kTooLong,      // not done in kMaxHoming_s
};

constexpr float kMaxHoming_s = 2.0f;

struct HomingState {
  bool is_started = false, is_done = false;
  HomingFault fault = HomingFault::kNone;
  uint32_t joint = 0, other = 0;  // of the fault
  int32_t offset[kMaxJoints] = {};

  // 0: all joints go to their low stops; 1: they are eased there, so that how far a stop gives way
  // says where it begins; k + 2: joint k goes up until it has passed its middle; then all are
  // pressed to their high stops, and eased; then all leave.
  uint32_t phase = 0;
  float total_s = 0, phase_s = 0, still_s = 0;
  uint32_t bad_in_a_row = 0;
  float rate_rad_per_s[kMaxJoints] = {};
  int32_t counts[kMaxJoints] = {};   // last accepted
  int32_t begin[kMaxJoints] = {};    // where the travel began
  int32_t still[kMaxJoints] = {};    // where the joints stand since still_s
  int32_t pressed[kMaxJoints] = {};  // where the joints stood in the phase before
  int32_t low[kMaxJoints] = {};      // where the low stops begin
  float far_rad[kMaxJoints] = {};    // the farthest from where the travel began
  uint32_t pulses = 0;               // bit k: joint k has passed one, at pulse[k]
  int32_t pulse[kMaxJoints] = {};
};

struct HomingTorques {
  float torque_Nm[kMaxJoints];  // 0 at the end, after a fault, and for a bad sample
};

/// Whether torques, speed, margin and, by index, periods are finite and above 0; the margin is at
/// most a period, so that travels within it cannot choose a neighbour of the index pulse.
bool check_homing(const HomingSettings& settings, const JointSettings& joints);

/// One tick. Until `is_done` the motors take these torques and nothing else; then counts + offset
/// are those of `joints`, of which the controller's first tick takes the first.
/// All joints are driven to their low stops, then up, each when the one before has passed its
/// middle, so that this names a reversed, swapped or dead axis. Pressed by all of the torque and by
/// half of it, a stop gives way by a length and half of it: the travel between stops that nothing
/// presses is compared with the range, whether they are hard or soft, or one of them a finger. In
/// the end all joints leave, so that they stand within their ranges. A driven
/// joint has the torque x (share - rate / speed), from 0 to the torque: never above it, and never
/// against its way.
/// Pre: check(joints) passed. Bounds: constant; re-entrant. Result: finite; `fault` or `is_done`
/// within kMaxHoming_s of samples.
/// Error: by index within a count where range x counts_per_rad < 2^23; by stops the asymmetry of
/// the stops, and of weight and friction against their stiffness (tests/device/homing_test.cpp).
HomingTorques home(HomingState& state, const HomingSettings& settings, const JointSettings& joints,
                   const HomingSample& sample);

/// "blocked: ..." for a message.
const char* fault_name(HomingFault fault);

}  // namespace firmtouch::device
