#include "firmtouch/device/velocity.hpp"

namespace firmtouch::device {
namespace {

constexpr float kTwoPi = 6.2831853f;

// Shares of a miss that correct the slope and the bend. Chosen on the errors at 1 and 10 kHz
// (`firmtouch bench velocity`). Shares of 0.6 and 0.12 with 10 ms give a stiffer wall at rest, but
// at some constant speeds they never settle.
constexpr float kSlopeShare = 0.65f;
constexpr float kBendShare = 0.06f;
// The bend is forgotten with this time constant: it must not carry an axis that stands.
constexpr float kForget_s = 0.005f;
// Shorter times between corrections count as this: at 10 kHz a count a tick is 300 mm/s.
constexpr float kMinSince_s = 0.7e-3f;
// The slope and the bend stay within these, also for steps that no axis can move: 100 m/s at 1e8
// counts a metre, reached in a millisecond.
constexpr float kMaxCounts_per_s = 1e10f;
constexpr float kMaxCounts_per_s2 = 1e13f;

float clamp(float value, float limit) {
  return value > limit ? limit : (value < -limit ? -limit : value);
}

// a dt / (dt + tau): the backward-difference form of a first-order low-pass, stable for every dt >
// 0.
void low_pass(VelocityState& state, float quotient, float filter_Hz, float dt_s) {
  const float tau_s = 1.0f / (kTwoPi * filter_Hz);
  const float share = dt_s / (dt_s + tau_s);
  state.units_per_s = state.units_per_s + (quotient - state.units_per_s) * share;
}

void track(VelocityState& state, float counts_per_unit, float step, float dt_s) {
  const float bend = state.counts_per_s2;
  state.since_s = state.since_s + dt_s;
  const float end = state.within + ((state.counts_per_s + 0.5f * bend * dt_s) * dt_s - step);
  state.counts_per_s = clamp(state.counts_per_s + bend * dt_s, kMaxCounts_per_s);
  state.counts_per_s2 = bend * (kForget_s / (kForget_s + dt_s));
  state.within = end > 0.0f ? (end < 1.0f ? end : 1.0f) : 0.0f;
  const float miss = state.within - end;
  if (miss < 0.0f || miss > 0.0f) {
    const float per_s = 1.0f / (state.since_s > kMinSince_s ? state.since_s : kMinSince_s);
    state.counts_per_s = clamp(state.counts_per_s + kSlopeShare * miss * per_s, kMaxCounts_per_s);
    state.counts_per_s2 =
        clamp(state.counts_per_s2 + kBendShare * miss * per_s * per_s, kMaxCounts_per_s2);
    state.since_s = 0.0f;
  }
  state.units_per_s = state.counts_per_s / counts_per_unit;
}

}  // namespace

float estimate(VelocityState& state, const VelocitySettings& settings, float counts_per_unit,
               float step, float dt_s) {
  if (settings.estimator == Estimator::kTracking) {
    track(state, counts_per_unit, step, dt_s);
  } else {
    const float quotient = step / (counts_per_unit * dt_s);
    if (settings.estimator == Estimator::kLowPass) {
      low_pass(state, quotient, settings.filter_Hz, dt_s);
    } else {
      state.units_per_s = quotient;
    }
  }
  return state.units_per_s;
}

void stop(VelocityState& state) {
  state.units_per_s = 0.0f;
  state.counts_per_s = 0.0f;
  state.counts_per_s2 = 0.0f;
}

}  // namespace firmtouch::device
