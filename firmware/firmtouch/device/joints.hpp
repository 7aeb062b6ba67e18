#pragma once
#include <stdint.h>

#include "firmtouch/core/status.hpp"
#include "firmtouch/device/cartesian.hpp"
#include "firmtouch/device/velocity.hpp"

// Angles and rates of a linkage's driven joints, from their encoders. The linkages turn them into a
// tip: five_bar.hpp, serial_arm.hpp, delta.hpp, or one of the user's own.
namespace firmtouch::device {

constexpr uint32_t kMaxJoints = 3;

struct JointSetting {
  float counts_per_rad = 1;  // negative: the encoder counts the other way
  float zero_rad = 0;        // angle at a count of 0
  float low_rad = -1;        // range of motion
  float high_rad = 1;
};

struct JointSettings {
  uint32_t joints = kMaxJoints;
  JointSetting joint[kMaxJoints];
  float max_speed_rad_per_s = 100;
  VelocitySettings velocity = {Estimator::kTracking, 150};
};

struct JointState {
  struct Joint {
    int32_t counts = 0;  // last accepted; wraps far beyond every range
    float angle_rad = 0;
    VelocityState velocity;
  };
  bool started = false;
  Joint joint[kMaxJoints];
  float since_accepted_s = 0;
  uint32_t bad_in_a_row = 0;
  uint32_t bad_history = 0;  // bit k: the sample k ticks ago
};

/// Joints that the linkage does not have are at 0 and rest.
struct Joints {
  float angle_rad[kMaxJoints];  // clamped to the range
  float rate_rad_per_s[kMaxJoints];
  float margin_rad;  // from the nearest end of a range; 0 beyond one
  uint32_t faults;   // kEncoderFault, kWorkspaceFault
  bool accepted;
  bool started;  // false until a sample was accepted: the angles are not measured yet
};

/// The rule that the settings break, with the joint as element; rule_name() in rules.hpp.
core::Verdict check(const JointSettings& settings);

/// As read() of a Cartesian device: wrap, plausible steps, rejected samples, velocity estimator,
/// and the faults' limits. An angle beyond its range is clamped to it, with kWorkspaceFault.
/// Pre: check(settings) passed. Bounds: constant; re-entrant. Result: always finite.
Joints read_joints(JointState& state, const JointSettings& settings, const Sample& sample);

/// Ignores earlier bad samples, so that a cleared fault does not come back by itself.
void clear(JointState& state);

}  // namespace firmtouch::device
