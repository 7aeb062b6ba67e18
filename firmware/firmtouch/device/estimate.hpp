#pragma once
#include "firmtouch/device/velocity.hpp"
#include "firmtouch/math/isa.hpp"

// The tracking line of velocity.hpp, inline. For .cpp files of this module alone.
namespace firmtouch::device {

// Share of a miss that corrects the slope, share of a correction that leads, and the time constant
// with which the lead is forgotten. Chosen on errors at 1 and 10 kHz and on the stiffest wall at
// rest (`firmtouch bench velocity`, `firmtouch-sim z-width --estimators`, November 2026). A lead
// that is fed back, as a bend of the line, is better on a sine but cycles in steady motion.
constexpr float kShare = 0.57f;
constexpr float kLeadShare = 0.3f;
constexpr float kForget_s = 0.004f;
// Shorter times between corrections count as this: at 10 kHz a count a tick is 300 mm/s.
constexpr float kMinSince_s = 0.7e-3f;

// What is left of a lead after dt_s.
static inline float kept_lead(float dt_s) { return kForget_s / (kForget_s + dt_s); }

static inline void track(VelocityState& state, float counts_per_unit, float step, float dt_s,
                         float kept) {
  state.since_s = state.since_s + dt_s;
  state.lead_counts_per_s = state.lead_counts_per_s * kept;
  const float end = state.within + (state.counts_per_s * dt_s - step);
  state.within = math::smaller(math::larger(end, 0.0f), 1.0f);
  const float miss = state.within - end;
  if (math::bits_of(miss) << 1 != 0) {  // not 0
    const float correction = kShare * miss / math::larger(state.since_s, kMinSince_s);
    state.counts_per_s = state.counts_per_s + correction;
    state.lead_counts_per_s = state.lead_counts_per_s + kLeadShare * correction;
    state.since_s = 0.0f;
  }
  state.units_per_s = (state.counts_per_s + state.lead_counts_per_s) / counts_per_unit;
}

}  // namespace firmtouch::device
