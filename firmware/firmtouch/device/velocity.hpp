#pragma once
#include <stdint.h>

// Velocity of one axis from its encoder's counts. A unit is a metre or a radian.
namespace firmtouch::device {

/// Values of the parameter velocity_estimator. Append-only. `firmtouch bench velocity` compares
/// them with windows and edge time stamps, which are not built in here.
enum class Estimator : uint8_t {
  kDifference,  // of the last two samples
  kLowPass,     // the difference through a first-order low-pass
  kTracking,    // a line through the counts, corrected where it leaves one
};

struct VelocitySettings {
  Estimator estimator;
  float filter_Hz;  // kLowPass
};

struct VelocityState {
  float units_per_s = 0;  // the last estimate
  // kTracking: the line's end, from 0 to 1 in the current count, its slope, and the lead on it.
  float within = 0.5f;
  float counts_per_s = 0;
  float lead_counts_per_s = 0;
  float since_s = 0;  // time since the last correction
};

/// The velocity after a motion of `step` counts in `dt_s`.
/// kTracking extrapolates a line. An encoder bounds the position to one count. Where the line
/// leaves it, its end is moved to the nearer bound, and its slope is corrected by a share of the
/// miss over the time since the last correction. So steady motion is estimated without error in the
/// end, and a change is followed fast, because misses then follow each other. A share of recent
/// corrections is added to the result, against the lag; it is not fed back.
/// Pre: dt_s > 0 and counts_per_unit != 0, both finite.
/// Bounds: constant; four divisions. Result: finite, also at rest after any history.
float estimate(VelocityState& state, const VelocitySettings& settings, float counts_per_unit,
               float step, float dt_s);

/// The axis is taken to be at rest.
void stop(VelocityState& state);

}  // namespace firmtouch::device
