#pragma once
#include <stdint.h>

namespace firmtouch::device {

/// What a check of a device's data found. Append-only.
enum LinkageRule : uint16_t {
  kRuleJointCount = 1,  // 1 to 3 joints; a serial arm: 2 or 3
  kRuleCountsPerRad,    // 1 to 1e7 either way
  kRuleZeroAngle,       // within 100 rad
  kRuleAngleRange,      // low < high, within 100 rad
  kRuleMaxSpeed,        // above 0, to 10,000 rad/s
  kRuleEstimator,       // an estimator, and a filter above 0, to 100 kHz
  kRuleLinkLength,      // 1 mm to 10 m
  kRuleOffset,          // finite, within 10 m; a base not below 0
  kRuleNeverCloses,     // no angles at which the links meet
  kRuleMaxTorque,       // above 0, to 1,000 N m
  kRuleFade             // 0.001 <= gone < full <= 1
};

/// Name, range and unit of a rule, for a message.
const char* rule_name(uint16_t rule);

/// Shared by the checks of linkages. False for NaN.
bool is_link_length(float length_m);
bool is_offset(float offset_m);

}  // namespace firmtouch::device
