#include "firmtouch/device/joints.hpp"

#include <float.h>

#include "firmtouch/device/estimate.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/samples.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

constexpr float kMaxAngle_rad = 100.0f;   // 16 turns
constexpr float kMaxCountsPerRad = 1e7f;  // so that no range comes near to the wrap
constexpr float kMaxSpeed_rad_per_s = 1e4f;
constexpr float kMaxFilter_Hz = 1e5f;

float size(float a) { return __builtin_fabsf(a); }

// A step of more than the largest speed allows is not plausible, nor is a sample that says so. One
// count more: a standing joint may flicker between two.
bool is_plausible(const JointState& state, const JointSettings& settings, const Sample& sample,
                  float (&step)[kMaxJoints]) {
  if (!sample.trusted) return false;
  const float most_rad = settings.max_speed_rad_per_s * state.since_accepted_s;
  float least_spare = FLT_MAX;  // a minimum branches less than an and
// 20 instructions less with three joints.
#pragma GCC unroll 3
  for (uint32_t k = 0; k < settings.joints; ++k) {
    const float most = most_rad * size(settings.joint[k].counts_per_rad) + 1.0f;
    step[k] = static_cast<float>(difference(sample.counts[k], state.joint[k].counts));
    least_spare = math::smaller(most - size(step[k]), least_spare);
  }
  return least_spare >= 0.0f;
}

void set_angle(JointState::Joint& joint, const JointSetting& setting, int32_t counts) {
  joint.counts = counts;
  joint.angle_rad = setting.zero_rad + static_cast<float>(counts) / setting.counts_per_rad;
}

// noinline: as report_all() below.
[[gnu::noinline]] void set_angles(JointState& state, const JointSettings& settings,
                                  const Sample& sample) {
  for (uint32_t k = 0; k < settings.joints; ++k)
    set_angle(state.joint[k], settings.joint[k], sample.counts[k]);
}

// Inline: angle, rate and margin are then in registers where they were computed.
inline float report(Joints& joints, const JointState::Joint& joint, const JointSetting& setting,
                    uint32_t k, float margin_rad) {
  joints.angle_rad[k] = joint.angle_rad;
  joints.rate_rad_per_s[k] = joint.velocity.units_per_s;
  const float above_rad = joint.angle_rad - setting.low_rad;
  const float below_rad = setting.high_rad - joint.angle_rad;
  return math::smaller(math::smaller(above_rad, below_rad), margin_rad);
}

// noinline: only the first sample and rejected ones need it; inlined it takes 120 B of flash more.
[[gnu::noinline]] void report_all(Joints& joints, const JointState& state,
                                  const JointSettings& settings) {
  joints.margin_rad = FLT_MAX;
  for (uint32_t k = 0; k < settings.joints; ++k)
    joints.margin_rad = report(joints, state.joint[k], settings.joint[k], k, joints.margin_rad);
}

// Reports each joint in the same loop: a second loop takes 20 instructions with three joints.
void track_all(JointState& state, const JointSettings& settings, const Sample& sample,
               const float (&step)[kMaxJoints], Joints& joints) {
  const float dt_s = state.since_accepted_s, kept = kept_lead(dt_s);
  float margin_rad = FLT_MAX;
  for (uint32_t k = 0; k < settings.joints; ++k) {
    JointState::Joint& joint = state.joint[k];
    const JointSetting& setting = settings.joint[k];
    set_angle(joint, setting, sample.counts[k]);
    track(joint.velocity, setting.counts_per_rad, step[k], dt_s, kept);
    margin_rad = report(joints, joint, setting, k, margin_rad);
  }
  joints.margin_rad = margin_rad;
}

void accept(JointState& state, const JointSettings& settings, const Sample& sample,
            const float (&step)[kMaxJoints], Joints& joints) {
  if (__builtin_expect(settings.velocity.estimator == Estimator::kTracking, 1)) {
    track_all(state, settings, sample, step, joints);
  } else {
    set_angles(state, settings, sample);
    for (uint32_t k = 0; k < settings.joints; ++k)
      (void)estimate(state.joint[k].velocity, settings.velocity, settings.joint[k].counts_per_rad,
                     step[k], state.since_accepted_s);
    report_all(joints, state, settings);
  }
  state.since_accepted_s = 0;
  state.bad_in_a_row = 0;
}

void extrapolate(JointState& state, const Sample& sample) {
  const float dt_s = clamp(sample.dt_s, kMinStep_s, kMaxStep_s);
  if (state.bad_in_a_row < kBadInARow) ++state.bad_in_a_row;
  for (JointState::Joint& joint : state.joint) {
    if (state.bad_in_a_row <= kExtrapolatedSamples) {
      joint.angle_rad += joint.velocity.units_per_s * dt_s;
    } else {
      stop(joint.velocity);
    }
  }
  state.bad_history |= 1u;
}

bool start(JointState& state, const JointSettings& settings, const Sample& sample) {
  if (!sample.trusted) return false;
  state = JointState{};
  state.started = true;
  set_angles(state, settings, sample);
  return true;
}

bool take(JointState& state, const JointSettings& settings, const Sample& sample, Joints& joints) {
  if (!state.started) {
    const bool started = start(state, settings, sample);
    report_all(joints, state, settings);
    return started;
  }
  state.since_accepted_s =
      math::smaller(math::larger(state.since_accepted_s + sample.dt_s, kMinStep_s), kMaxStep_s);
  state.bad_history <<= 1;
  float step[kMaxJoints];
  const bool accepted = is_plausible(state, settings, sample, step);
  if (accepted) {
    accept(state, settings, sample, step, joints);
  } else {
    extrapolate(state, sample);
    report_all(joints, state, settings);
  }
  return accepted;
}

void clamp_to_range(JointState& state, const JointSettings& settings, Joints& joints) {
  for (uint32_t k = 0; k < settings.joints; ++k) {
    float& angle_rad = state.joint[k].angle_rad;
    angle_rad = clamp(angle_rad, settings.joint[k].low_rad, settings.joint[k].high_rad);
    joints.angle_rad[k] = angle_rad;
  }
  joints.margin_rad = 0.0f;
  joints.faults |= kWorkspaceFault;
}

}  // namespace

core::Verdict check(const JointSettings& settings) {
  if (settings.joints == 0 || settings.joints > kMaxJoints) return reject(kRuleJointCount);
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    const JointSetting& joint = settings.joint[k];
    const float scale = size(joint.counts_per_rad);
    if (!(scale >= 1.0f && scale <= kMaxCountsPerRad)) return reject(kRuleCountsPerRad, k);
    if (!(size(joint.zero_rad) <= kMaxAngle_rad)) return reject(kRuleZeroAngle, k);
    if (!(joint.low_rad < joint.high_rad && joint.low_rad >= -kMaxAngle_rad &&
          joint.high_rad <= kMaxAngle_rad))
      return reject(kRuleAngleRange, k);
  }
  if (!(settings.max_speed_rad_per_s > 0.0f && settings.max_speed_rad_per_s <= kMaxSpeed_rad_per_s))
    return reject(kRuleMaxSpeed);
  if (settings.velocity.estimator > Estimator::kTracking ||
      !(settings.velocity.filter_Hz > 0.0f && settings.velocity.filter_Hz <= kMaxFilter_Hz))
    return reject(kRuleEstimator);
  return core::kPassed;
}

Joints read_joints(JointState& state, const JointSettings& settings, const Sample& sample) {
  Joints joints;  // each member is set below: no memset
  joints.angle_rad[1] = joints.angle_rad[2] = 0.0f;
  joints.rate_rad_per_s[1] = joints.rate_rad_per_s[2] = 0.0f;
  joints.accepted = take(state, settings, sample, joints);
  joints.started = state.started;
  const bool is_bad = !state.started || state.bad_in_a_row >= kBadInARow ||
                      count_bits(state.bad_history) >= kBadOf32;
  joints.faults = is_bad ? kEncoderFault : 0;
  if (joints.margin_rad < 0.0f) clamp_to_range(state, settings, joints);
  return joints;
}

void clear(JointState& state) {
  state.bad_in_a_row = 0;
  state.bad_history = 0;
}

}  // namespace firmtouch::device
