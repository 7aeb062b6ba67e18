#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

// A device of three straight axes at right angles, one encoder each: joint and device frame are
// one.
namespace firmtouch::device {

constexpr uint32_t kAxes = 3;

// Bits of Reading::faults; servo/fault.hpp says what follows from them.
constexpr uint32_t kEncoderFault = 1u << 0;
constexpr uint32_t kWorkspaceFault = 1u << 1;

// A sample that is not believed is bridged: the first two by going on at the last velocity, then
// the place is held. With the third in a row, or the sixth of the last 32, the encoder is at fault.
constexpr uint32_t kBridgedSamples = 2;
constexpr uint32_t kBadInARow = 3;
constexpr uint32_t kBadOf32 = 6;

struct Settings {
  float counts_per_metre[kAxes];
  math::Vec3 origin_m;  // position at a count of 0, and centre of the workspace
  math::Vec3 workspace_half_m;
  float max_speed_mps;       // of an axis
  float velocity_filter_Hz;  // first-order low-pass on the difference quotient
};

/// One tick's look at the encoders.
struct Sample {
  int32_t counts[kAxes];
  bool trusted;  // false: the encoder itself says that these counts are not valid
  float dt_s;    // measured time since the sample before
};

struct State {
  bool started = false;
  int32_t counts[kAxes] = {};  // last believed
  int64_t total[kAxes] = {};   // the same without the wrap
  math::Vec3 position_m;
  math::Vec3 velocity_mps;
  float since_believed_s = 0;
  uint32_t bad_in_a_row = 0;
  uint32_t bad_history = 0;  // bit k: the sample k ticks ago
};

struct Reading {
  math::Vec3 position_m;
  math::Vec3 velocity_mps;
  uint32_t faults = 0;
  bool believed = false;
  bool started = false;  // a sample was believed once: before, the position is not a measured one
};

/// Position and velocity from this tick's counts. Counts wrap at 32 bits: what matters is their
/// difference. The first sample is believed as it is. A step of more than max_speed_mps over the
/// time since the last believed sample is not.
/// Bounds: constant; re-entrant.
/// Result: always finite; before the first believed sample `started` is false, the position means
/// nothing and kEncoderFault is set; the position lies within the workspace, or is clamped to it with
/// kWorkspaceFault.
/// Error:  the quantum is 1 / counts_per_metre; beyond it the position is within 1.5 ulp of the
/// larger of |origin| and |position - origin|, counts above 2^24 included
/// (tests/device/cartesian_test.cpp).
Reading read(State& state, const Settings& settings, const Sample& sample);

/// Forgets bad samples, so that a fault which was cleared does not come back by itself.
void forgive(State& state);

}  // namespace firmtouch::device
