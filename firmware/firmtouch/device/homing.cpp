#include "firmtouch/device/homing.hpp"

#include "firmtouch/device/samples.hpp"

namespace firmtouch::device {
namespace {

constexpr float kRateLag_s = 0.004f;
constexpr float kMinPhase_s = 0.02f;  // before a joint that stands counts as arrived
constexpr float kStill_s = 0.04f;
constexpr float kMaxPhase_s = 0.6f;     // a wrong axis may never stand; its travel names it
constexpr float kMaxExcess = 1.0f;      // of the range: how far both stops give way
constexpr float kInside = 0.0625f;      // of the range: how far from the high stops it ends
constexpr float kLeavingSpeed = 0.25f;  // of the speed, so that nothing coasts to the other stop
constexpr float kEased = 0.5f;          // of the torque: see unloaded()
constexpr float kStillShare = 0.0625f;  // of the margin: within it a joint stands
constexpr int32_t kDeadCounts = 2;
constexpr float kIndexCounts = 2;  // by which pulses may always miss whole periods
constexpr uint32_t kMaxBad = 3;
constexpr float kMaxTorque_Nm = 1000.0f;

// Phases: see HomingState.
constexpr uint32_t kEaseLow = 1, kUp = 2;

float size(float a) { return __builtin_fabsf(a); }
int32_t size(int32_t a) { return a < 0 ? -a : a; }

// To the nearest; halves away from 0. Pre: within the int32.
int32_t nearest(float a) { return static_cast<int32_t>(a < 0.0f ? a - 0.5f : a + 0.5f); }

bool is_above_0(float a, float most) { return a > 0.0f && a <= most; }

HomingTorques fail(HomingState& state, HomingFault fault, uint32_t joint) {
  state.fault = fault;
  state.joint = joint;
  return {};
}

float travel_rad(const HomingState& state, const JointSettings& joints, uint32_t k) {
  return static_cast<float>(difference(state.counts[k], state.begin[k])) /
         joints.joint[k].counts_per_rad;
}

// The offset that puts `counts` at an angle.
int32_t offset_at(const JointSetting& joint, float angle_rad, int32_t counts) {
  return difference(nearest((angle_rad - joint.zero_rad) * joint.counts_per_rad), counts);
}

float range_of(const JointSetting& joint) { return joint.high_rad - joint.low_rad; }

// The joint that begins to go up; all do where this is no joint's number.
uint32_t rising(const HomingState& state) { return state.phase - kUp; }

bool goes_up(const HomingState& state, uint32_t k) { return state.phase >= kUp + k; }

void begin_phase(HomingState& state) {
  state.phase_s = state.still_s = 0;
  for (uint32_t k = 0; k < kMaxJoints; ++k) {
    state.still[k] = state.counts[k];
    if (state.phase > kUp + k) continue;
    state.begin[k] = state.counts[k];
    state.far_rad[k] = 0;
  }
}

// Result: false if no motion is needed, or it failed.
bool start(HomingState& state, const HomingSettings& settings, const JointSettings& joints,
           const HomingSample& sample) {
  state.is_started = true;
  if (!check_homing(settings, joints)) {
    fail(state, HomingFault::kSettings, 0);
    return false;
  }
  for (uint32_t k = 0; k < joints.joints; ++k) state.counts[k] = sample.encoders.counts[k];
  begin_phase(state);
  if (settings.by == HomeBy::kStops || settings.by == HomeBy::kIndex) return true;
  for (uint32_t k = 0; k < joints.joints; ++k) {
    const JointSetting& joint = joints.joint[k];
    const float angle_rad =
        settings.by == HomeBy::kAbsolute ? sample.absolute_rad[k] : settings.pose_rad[k];
    if (!(angle_rad >= joint.low_rad - settings.margin_rad &&
          angle_rad <= joint.high_rad + settings.margin_rad)) {
      fail(state, HomingFault::kDeadEncoder, k);
      return false;
    }
    state.offset[k] = offset_at(joint, angle_rad, state.counts[k]);
  }
  state.is_done = true;
  return false;
}

// Takes counts and rates of a sample. Result: false if it is invalid or too far from the last.
bool take(HomingState& state, const JointSettings& joints, const Sample& sample, float margin_rad,
          float dt_s) {
  bool is_good = sample.trusted;
  const float most_rad = joints.max_speed_rad_per_s * dt_s * static_cast<float>(kMaxBad);
  for (uint32_t k = 0; k < joints.joints; ++k) {
    const float step = static_cast<float>(difference(sample.counts[k], state.counts[k]));
    is_good &= size(step) <= most_rad * size(joints.joint[k].counts_per_rad) + 1.0f;
  }
  if (!is_good) return false;
  state.still_s += dt_s;
  for (uint32_t k = 0; k < joints.joints; ++k) {
    const float step = static_cast<float>(difference(sample.counts[k], state.counts[k]));
    const float rate = step / (joints.joint[k].counts_per_rad * dt_s);
    state.rate_rad_per_s[k] += (rate - state.rate_rad_per_s[k]) * (dt_s / (dt_s + kRateLag_s));
    state.counts[k] = sample.counts[k];
    const float moved = static_cast<float>(difference(state.counts[k], state.still[k]));
    if (size(moved) <= kStillShare * margin_rad * size(joints.joint[k].counts_per_rad) + 1.0f)
      continue;
    state.still[k] = state.counts[k];
    state.still_s = 0;
  }
  return true;
}

// A later pulse must be whole periods from the first.
bool take_pulse(HomingState& state, const HomingSettings& settings, const JointSettings& joints,
                const HomingSample& sample, uint32_t k) {
  if ((sample.pulses >> k & 1u) == 0 || settings.by != HomeBy::kIndex) return true;
  if ((state.pulses >> k & 1u) == 0) state.pulse[k] = sample.latched[k];
  state.pulses |= 1u << k;
  const float period = settings.index_period_rad[k] * size(joints.joint[k].counts_per_rad);
  const float apart = static_cast<float>(difference(sample.latched[k], state.pulse[k]));
  const float turns = apart / period;
  if (!(size(turns) < 1e6f)) return false;
  const float within = settings.index_within_rad * size(joints.joint[k].counts_per_rad);
  const float off = size(apart - static_cast<float>(nearest(turns)) * period);
  return off <= kIndexCounts || off <= within;
}

// Where the stop begins that the joint stands at. It gives way as the torque, and twice as far
// under all of it as under half.
int32_t unloaded(const HomingState& state, uint32_t k) {
  const uint32_t eased = static_cast<uint32_t>(state.counts[k]);
  return static_cast<int32_t>(2 * eased - static_cast<uint32_t>(state.pressed[k]));
}

// The joint `k` stands eased at its high stop.
HomingFault find_offset(HomingState& state, const HomingSettings& settings,
                        const JointSetting& joint, uint32_t k) {
  const int32_t low = state.low[k], travel = difference(unloaded(state, k), low);
  const float travel_rad = static_cast<float>(travel) / joint.counts_per_rad;
  if (!(travel_rad >= range_of(joint) - settings.margin_rad)) return HomingFault::kBlocked;
  if (!(travel_rad <= range_of(joint) + settings.margin_rad)) return HomingFault::kNoStop;
  // Half of the travel, so that counts may wrap.
  const int32_t middle =
      static_cast<int32_t>(static_cast<uint32_t>(low) + static_cast<uint32_t>(travel / 2));
  const float middle_rad = 0.5f * (joint.low_rad + joint.high_rad);
  state.offset[k] = offset_at(joint, middle_rad, middle);
  if (settings.by != HomeBy::kIndex) return HomingFault::kNone;
  if ((state.pulses >> k & 1u) == 0) return HomingFault::kNoIndex;
  const float from_middle = static_cast<float>(difference(state.pulse[k], middle));
  const float rough_rad = middle_rad + from_middle / joint.counts_per_rad;
  const float period_rad = settings.index_period_rad[k];
  const float number =
      static_cast<float>(nearest((rough_rad - settings.index_rad[k]) / period_rad));
  const float exact_rad = settings.index_rad[k] + number * period_rad;
  if (!(size(rough_rad - exact_rad) <= 0.25f * period_rad)) return HomingFault::kWrongIndex;
  state.offset[k] = offset_at(joint, exact_rad, state.pulse[k]);
  return HomingFault::kNone;
}

// The travel that says that there is no stop.
float endless_rad(const HomingSettings& settings, const JointSetting& joint) {
  return range_of(joint) * (1.0f + kMaxExcess) + settings.margin_rad;
}

// Whether a joint has passed the middle of the range of `k`, which is driven. The first one counts:
// another axis that is driven in truth swings `k` where it meets its stop.
bool has_one_gone(HomingState& state, const JointSettings& joints, uint32_t k) {
  for (state.other = k; k < joints.joints && state.other < joints.joints; ++state.other)
    if (size(state.far_rad[state.other]) > 0.5f * range_of(joints.joint[k])) return true;
  return false;
}

// What the travels say of the axes when all joints stand at their low stops, or one of them has
// gone up, or stands.
HomingFault fault_of_axes(HomingState& state, const HomingSettings& settings,
                          const JointSettings& joints) {
  const float margin_rad = settings.margin_rad;
  if (state.phase == 0) {
    for (state.joint = 0; state.joint < joints.joints; ++state.joint)
      if (state.far_rad[state.joint] > margin_rad) return HomingFault::kWrongWay;
    return HomingFault::kNone;
  }
  const uint32_t k = state.joint = rising(state);
  if (has_one_gone(state, joints, k)) {
    if (state.other != k) return HomingFault::kSwapped;
    if (state.far_rad[k] > 0.0f) return HomingFault::kNone;
  }
  if (state.far_rad[k] < -margin_rad) return HomingFault::kWrongWay;
  if (size(difference(state.counts[k], state.begin[k])) <= kDeadCounts)
    return HomingFault::kDeadEncoder;
  return HomingFault::kBlocked;
}

bool is_eased(const HomingState& state, const JointSettings& joints) {
  return state.phase == kEaseLow || state.phase == kUp + joints.joints + 1;
}

void end_phase(HomingState& state, const HomingSettings& settings, const JointSettings& joints) {
  if (state.phase == kEaseLow) {
    for (uint32_t k = 0; k < kMaxJoints; ++k) state.low[k] = unloaded(state, k);
  } else if (state.phase < kUp + joints.joints) {
    state.fault = fault_of_axes(state, settings, joints);
  } else if (is_eased(state, joints)) {
    for (uint32_t k = 0; k < joints.joints && state.fault == HomingFault::kNone; ++k)
      state.fault = find_offset(state, settings, joints.joint[state.joint = k], k);
  }
  for (uint32_t k = 0; k < kMaxJoints; ++k) state.pressed[k] = state.counts[k];
  ++state.phase;
  begin_phase(state);
}

bool is_leaving(const HomingState& state, const JointSettings& joints) {
  return state.phase > kUp + joints.joints + 1;
}

// Of a joint whose offset is known.
bool is_inside(const HomingState& state, const JointSetting& joint, uint32_t k) {
  const int32_t counts = static_cast<int32_t>(static_cast<uint32_t>(state.counts[k]) +
                                              static_cast<uint32_t>(state.offset[k]));
  const float angle_rad = joint.zero_rad + static_cast<float>(counts) / joint.counts_per_rad;
  return angle_rad <= joint.high_rad - kInside * range_of(joint);
}

// Never against the way: a brake on the rate of a wrong axis would drive it.
HomingTorques drive(const HomingState& state, const HomingSettings& settings,
                    const JointSettings& joints) {
  HomingTorques out = {};
  const bool leaves = is_leaving(state, joints);
  const float part = is_eased(state, joints) ? kEased : 1.0f;
  const float speed_rad_per_s = settings.speed_rad_per_s * (leaves ? kLeavingSpeed : 1.0f);
  for (uint32_t k = 0; k < joints.joints; ++k) {
    const float way = goes_up(state, k) && !leaves ? 1.0f : -1.0f;
    if (leaves && is_inside(state, joints.joint[k], k)) continue;
    const float share = part - way * state.rate_rad_per_s[k] / speed_rad_per_s;
    out.torque_Nm[k] = way * settings.torque_Nm[k] * clamp(share, 0.0f, 1.0f);
  }
  return out;
}

}  // namespace

bool check_homing(const HomingSettings& settings, const JointSettings& joints) {
  if (settings.by > HomeBy::kIndex || !is_above_0(settings.margin_rad, 100.0f)) return false;
  if (settings.by == HomeBy::kKnownPose || settings.by == HomeBy::kAbsolute) return true;
  bool is_good = is_above_0(settings.speed_rad_per_s, joints.max_speed_rad_per_s);
  for (uint32_t k = 0; k < joints.joints; ++k) {
    is_good &= is_above_0(settings.torque_Nm[k], kMaxTorque_Nm);
    if (settings.by == HomeBy::kIndex)
      is_good &= is_above_0(settings.index_period_rad[k], range_of(joints.joint[k])) &&
                 settings.margin_rad <= settings.index_period_rad[k] &&
                 size(settings.index_rad[k]) <= 100.0f;
  }
  return is_good;
}

HomingTorques home(HomingState& state, const HomingSettings& settings, const JointSettings& joints,
                   const HomingSample& sample) {
  if (state.is_done || state.fault != HomingFault::kNone) return {};
  const float dt_s = clamp(sample.encoders.dt_s, kMinStep_s, kMaxStep_s);
  state.total_s += dt_s;
  const uint32_t up = rising(state), driven = up < joints.joints ? up : 0;
  if (state.total_s > kMaxHoming_s) return fail(state, HomingFault::kTooLong, driven);
  const bool is_good = state.is_started
                           ? take(state, joints, sample.encoders, settings.margin_rad, dt_s)
                           : sample.encoders.trusted;
  state.bad_in_a_row = is_good ? 0 : state.bad_in_a_row + 1;
  if (state.bad_in_a_row >= kMaxBad) return fail(state, HomingFault::kBadSamples, driven);
  if (!is_good) return {};
  if (!state.is_started && !start(state, settings, joints, sample)) return {};
  state.phase_s += dt_s;
  for (uint32_t k = 0; k < joints.joints; ++k) {
    const float travel = travel_rad(state, joints, k);
    if (size(travel) > endless_rad(settings, joints.joint[k]))
      return fail(state, HomingFault::kNoStop, k);
    if (size(travel) > size(state.far_rad[k])) state.far_rad[k] = travel;
  }
  if (is_leaving(state, joints)) {
    state.is_done = true;
    for (uint32_t k = 0; k < joints.joints; ++k)
      state.is_done &= is_inside(state, joints.joint[k], k);
  } else {
    for (uint32_t k = 0; k < joints.joints; ++k)
      if (goes_up(state, k) && !take_pulse(state, settings, joints, sample, k))
        return fail(state, HomingFault::kWrongIndex, k);
    const bool is_still = state.phase_s >= kMinPhase_s && state.still_s >= kStill_s;
    if (is_still || has_one_gone(state, joints, up) || state.phase_s > kMaxPhase_s)
      end_phase(state, settings, joints);
  }
  if (state.is_done || state.fault != HomingFault::kNone) return {};
  return drive(state, settings, joints);
}

const char* fault_name(HomingFault fault) {
  static const char* const kNames[] = {"none",
                                       "settings: torque, speed, margin or index period",
                                       "encoder: three bad samples in a row",
                                       "encoder or motor is dead, or its angle is out of the range",
                                       "axis is reversed: its counts go the other way",
                                       "axes are swapped",
                                       "blocked: the travel is shorter than the range",
                                       "no stop: the travel is longer than the range",
                                       "no index pulse",
                                       "index pulse disagrees with the stops",
                                       "not done in time"};
  const uint32_t number = static_cast<uint32_t>(fault);
  return number < sizeof kNames / sizeof kNames[0] ? kNames[number] : "unknown";
}

}  // namespace firmtouch::device
