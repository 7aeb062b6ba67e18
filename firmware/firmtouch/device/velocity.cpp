#include "firmtouch/device/velocity.hpp"

#include "firmtouch/device/estimate.hpp"

namespace firmtouch::device {

float estimate(VelocityState& state, const VelocitySettings& settings, float counts_per_unit,
               float step, float dt_s) {
  return estimate_inline(state, settings, counts_per_unit, step, dt_s, kept_lead(dt_s));
}

void stop(VelocityState& state) {
  state.units_per_s = 0.0f;
  state.counts_per_s = 0.0f;
  state.lead_counts_per_s = 0.0f;
}

}  // namespace firmtouch::device
