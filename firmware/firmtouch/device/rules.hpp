#pragma once
#include <stdint.h>

namespace firmtouch::device {

/// Why a linkage's data are rejected; the numbers never change. tools/FORMAT.md prints the same
/// text.
enum Rule : uint16_t {
  // There are not 1 to 3 joints; of a serial arm 2 or 3.
  kRuleJointCount = 701,
  // Counts per radian are not 1 to 1e7, with either sign.
  kRuleCountsPerRad = 702,
  // The angle at a count of 0 is not within 100 rad.
  kRuleZeroAngle = 703,
  // A range of angles does not rise, or is not within 100 rad.
  kRuleAngleRange = 704,
  // The largest speed of a joint is not above 0 and at most 10000 rad/s.
  kRuleMaxSpeed = 705,
  // There is no such velocity estimator, or its filter is not above 0 and at most 100 kHz.
  kRuleEstimator = 706,
  // A link is not 0.001 to 10 m long.
  kRuleLinkLength = 707,
  // An offset is not within 10 m, or a base is below 0.
  kRuleOffset = 708,
  // The links meet at no angles.
  kRuleNeverCloses = 709,
  // A torque limit is not above 0 and at most 1000 N m.
  kRuleMaxTorque = 710,
  // The fade is not 0.001 <= gone_at < full_from <= 1.
  kRuleFade = 711,
  // The section is not as long as a linkage, or, with parts that read them, as one with
  // its homing, its index pulses or second encoders, and its thermal limits.
  kRuleLinkageSize = 712,
  // There is no such kind of linkage, or not with so many joints.
  kRuleKind = 713,
  // A flag, or a word that this kind of linkage does not use, is not 0.
  kRuleUnused = 714,
  // The time of a torque's rise is not 0.0001 to 1 s.
  kRuleTorqueRise = 715,
  // A mass, or the least of the tip, is not 0 to 100 kg, gravity is not within 100 m/s2, or the
  // share of the torque limits that carries weight is not 0 to 0.9.
  kRuleLoad = 716,
  // Homing is neither by stops nor by a known pose, or a torque, the speed, the margin or a pose is
  // out of range, or a word that is not used is not 0.
  kRuleHoming = 717,
  // A second encoder's counts per radian are not 1 to 1e4, with either sign, or the tolerance is
  // not from 3 of its counts and one of the first to 60, or it is of no joint, or there is none.
  kRuleSecondEncoder = 718,
  // Homing is not by stops, an index pulse's angle or period is out of range (240 counts and the
  // margin of homing to the range), its tolerance is not 3 to 60 counts, or it is of no joint.
  kRuleIndex = 719,
  // A continuous torque is not above 0, from that of homing to the largest, its thermal time is not
  // from 0.1 s times the square of largest over continuous torque to 10000 s, or there is none.
  kRuleDerating = 720,
  // A spring's stiffness is not above 0 and at most 1000 N m/rad, or its relaxed angle is not
  // within 100 rad; a friction is not above 0 and at most the largest torque, its share is not
  // above 0 and at most 0.8, or its fade is not 0.001 to 100 rad/s; or one is of no joint, or there
  // is none.
  kRuleCompensation = 721,
};

/// What a rule demands, with range and unit, for a message.
const char* rule_name(uint16_t rule);

/// Shared by the checks of linkages. False for NaN.
bool is_link_length(float length_m);
bool is_offset(float offset_m);
/// Every bit, so that one linkage has one layout.
bool is_zero(float value);

}  // namespace firmtouch::device
