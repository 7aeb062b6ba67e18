#include "firmtouch/device/rules.hpp"

namespace firmtouch::device {
namespace {

constexpr float kMinLink_m = 1e-3f;
constexpr float kMaxLink_m = 10.0f;

}  // namespace

const char* rule_name(uint16_t rule) {
  static const char* const kNames[] = {
      "joint count: 1 to 3, of a serial arm 2 or 3",
      "counts per rad: 1 to 1e7, either sign",
      "angle at a count of 0: within 100 rad",
      "angle range: low below high, within 100 rad",
      "largest speed: above 0, to 10000 rad/s",
      "velocity estimator: 0 to 2, filter to 100000 Hz",
      "link length: 0.001 to 10 m",
      "offset: within 10 m, a base not below 0",
      "the links meet at no angles",
      "torque limit: above 0, to 1000 N m",
      "fade: 0.001 <= gone < full <= 1",
      "length of the section",
      "kind of linkage and its joints",
      "words that this kind does not use: 0",
      "torque rise: 0.0001 to 1 s",
      "load: masses of 0 to 100 kg, gravity within 100 m/s2, share 0 to 0.9",
      "homing: by stops or pose; torques, speed, margin, pose",
      "second encoders: 1 to 1e4 counts per rad; within 3 counts and one of the first, to 60",
      "index pulses: home stops; angle; period of 240 counts, margin to range; within 3 to 60",
      "continuous torque: homing's to largest; thermal time: 0.1 s (largest / it)^2 to 1e4",
      "spring: to 1000 N m/rad, relaxed within 100 rad; friction: to largest torque, share to 0.8"};
  constexpr uint32_t kCount = sizeof kNames / sizeof kNames[0];
  static_assert(kRuleJointCount + kCount == kRuleCompensation + 1);
  const uint32_t number = uint32_t{rule} - kRuleJointCount;
  return number < kCount ? kNames[number] : "unknown rule";
}

bool is_link_length(float length_m) { return length_m >= kMinLink_m && length_m <= kMaxLink_m; }

bool is_offset(float offset_m) { return offset_m >= -kMaxLink_m && offset_m <= kMaxLink_m; }

bool is_zero(float value) {
  uint32_t word;
  __builtin_memcpy(&word, &value, sizeof word);
  return word == 0;
}

}  // namespace firmtouch::device
