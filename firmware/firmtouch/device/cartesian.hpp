#pragma once
#include <stdint.h>

#include "firmtouch/device/velocity.hpp"
#include "firmtouch/math/vec3.hpp"

// A device of three straight axes at right angles, with one encoder each. Joint frame and device
// frame are the same.
namespace firmtouch::device {

constexpr uint32_t kAxes = 3;

// Bits of Reading::faults; servo/fault.hpp says what follows from them.
constexpr uint32_t kEncoderFault = 1u << 0;
constexpr uint32_t kWorkspaceFault = 1u << 1;

// A rejected sample is extrapolated at the last velocity for two ticks; then the position is held.
// The third in a row, or the sixth of the last 32, is an encoder fault.
constexpr uint32_t kExtrapolatedSamples = 2;
constexpr uint32_t kBadInARow = 3;
constexpr uint32_t kBadOf32 = 6;

struct Settings {
  float counts_per_metre[kAxes];
  math::Vec3 origin_m;  // position at a count of 0, and centre of the workspace
  math::Vec3 workspace_half_m;
  float max_speed_mps;  // of an axis
  VelocitySettings velocity;
};

/// The encoders in one tick.
struct Sample {
  int32_t counts[kAxes];
  bool trusted;  // false: the encoder reports these counts as invalid
  float dt_s;    // measured time since the sample before
};

struct State {
  bool started = false;
  int32_t counts[kAxes] = {};  // last accepted
  int64_t total[kAxes] = {};   // the same without the wrap
  math::Vec3 position_m;
  math::Vec3 velocity_mps;
  VelocityState velocity[kAxes];
  float since_accepted_s = 0;
  uint32_t bad_in_a_row = 0;
  uint32_t bad_history = 0;  // bit k: the sample k ticks ago
};

struct Reading {
  math::Vec3 position_m;
  math::Vec3 velocity_mps;
  uint32_t faults = 0;
  bool accepted = false;
  bool started = false;  // false until a sample was accepted: the position is not measured yet
};

/// Position and velocity from this tick's counts. Counts wrap at 32 bits; only their difference is
/// used. The first sample is accepted. Later ones are rejected if a step exceeds max_speed_mps
/// times the time since the last accepted sample, plus one count.
/// Bounds: constant; re-entrant.
/// Result: always finite. Before the first accepted sample `started` is false, the position is
///         meaningless and kEncoderFault is set. A position outside the workspace is clamped to it,
///         with kWorkspaceFault.
/// Error:  the quantum is 1 / counts_per_metre; beyond it the position is within 1.5 ulp of the
/// larger of |origin| and |position - origin|, counts above 2^24 included
/// (tests/device/cartesian_test.cpp).
Reading read(State& state, const Settings& settings, const Sample& sample);

/// Forgets bad samples, so that a cleared fault does not come back by itself.
void clear(State& state);

}  // namespace firmtouch::device
