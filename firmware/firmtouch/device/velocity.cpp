#include "firmtouch/device/velocity.hpp"

#include "firmtouch/device/estimate.hpp"

namespace firmtouch::device {
namespace {

// a dt / (dt + tau): the backward-difference form of a first-order low-pass, stable for every
// dt > 0.
void low_pass(VelocityState& state, float quotient, float filter_Hz, float dt_s) {
  constexpr float kTwoPi = 6.2831853f;
  const float tau_s = 1.0f / (kTwoPi * filter_Hz);
  const float share = dt_s / (dt_s + tau_s);
  state.units_per_s = state.units_per_s + (quotient - state.units_per_s) * share;
}

}  // namespace

float estimate(VelocityState& state, const VelocitySettings& settings, float counts_per_unit,
               float step, float dt_s) {
  if (settings.estimator == Estimator::kTracking) {
    track(state, counts_per_unit, step, dt_s, kept_lead(dt_s));
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
  state.lead_counts_per_s = 0.0f;
}

}  // namespace firmtouch::device
