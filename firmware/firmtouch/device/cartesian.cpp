#include "firmtouch/device/cartesian.hpp"

#include "firmtouch/device/samples.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::device {
namespace {

// Exact to 2^24, then rounded to nearest. What is beyond 32 bits is far outside every workspace.
float to_float(int64_t counts) {
  if (counts > INT32_MAX) return static_cast<float>(INT32_MAX);
  if (counts < INT32_MIN) return static_cast<float>(INT32_MIN);
  return static_cast<float>(static_cast<int32_t>(counts));
}

bool is_plausible(const int32_t (&step)[kAxes], const Settings& settings, float since_s) {
  for (uint32_t k = 0; k < kAxes; ++k) {
    // One count more than the speed allows: a standing axis may flicker between two.
    const float most = settings.max_speed_mps * since_s * settings.counts_per_metre[k] + 1.0f;
    const float counts = to_float(step[k]);
    if (!(counts <= most) || !(counts >= -most)) return false;
  }
  return true;
}

math::Vec3 position_of(const State& state, const Settings& settings) {
  return settings.origin_m + math::Vec3{to_float(state.total[0]) / settings.counts_per_metre[0],
                                        to_float(state.total[1]) / settings.counts_per_metre[1],
                                        to_float(state.total[2]) / settings.counts_per_metre[2]};
}

void estimate_velocity(State& state, const Settings& settings, const int32_t (&step)[kAxes],
                       float since_s) {
  for (uint32_t k = 0; k < kAxes; ++k)
    (void)estimate(state.velocity[k], settings.velocity, settings.counts_per_metre[k],
                   to_float(step[k]), since_s);
  state.velocity_mps = {state.velocity[0].units_per_s, state.velocity[1].units_per_s,
                        state.velocity[2].units_per_s};
}

bool clamp_to_workspace(math::Vec3& position_m, const Settings& settings) {
  const math::Vec3 low = settings.origin_m - settings.workspace_half_m;
  const math::Vec3 high = settings.origin_m + settings.workspace_half_m;
  const math::Vec3 inside{clamp(position_m.x, low.x, high.x), clamp(position_m.y, low.y, high.y),
                          clamp(position_m.z, low.z, high.z)};
  const math::Vec3 off = position_m - inside;
  const bool was_inside = math::dot(off, off) <= 0.0f;
  position_m = inside;
  return was_inside;
}

void accept(State& state, const Settings& settings, const Sample& sample,
            const int32_t (&step)[kAxes]) {
  for (uint32_t k = 0; k < kAxes; ++k) {
    state.counts[k] = sample.counts[k];
    state.total[k] += step[k];
  }
  estimate_velocity(state, settings, step, state.since_accepted_s);
  state.position_m = position_of(state, settings);
  state.since_accepted_s = 0;
  state.bad_in_a_row = 0;
}

void extrapolate(State& state, float dt_s) {
  if (state.bad_in_a_row < kBadInARow) ++state.bad_in_a_row;
  if (state.bad_in_a_row <= kExtrapolatedSamples) {
    state.position_m = state.position_m + state.velocity_mps * dt_s;
  } else {
    for (VelocityState& axis : state.velocity) stop(axis);
    state.velocity_mps = {};
  }
  state.bad_history |= 1u;
}

void start(State& state, const Settings& settings, const Sample& sample) {
  state = State{};
  state.started = true;
  for (uint32_t k = 0; k < kAxes; ++k) state.total[k] = state.counts[k] = sample.counts[k];
  state.position_m = position_of(state, settings);
}

}  // namespace

Reading read(State& state, const Settings& settings, const Sample& sample) {
  const float dt_s = clamp(sample.dt_s, kMinStep_s, kMaxStep_s);
  bool accepted = sample.trusted;
  if (!state.started) {
    if (accepted) start(state, settings, sample);
  } else {
    int32_t step[kAxes];
    for (uint32_t k = 0; k < kAxes; ++k) step[k] = difference(sample.counts[k], state.counts[k]);
    state.since_accepted_s = clamp(state.since_accepted_s + dt_s, kMinStep_s, kMaxStep_s);
    state.bad_history <<= 1;
    accepted = accepted && is_plausible(step, settings, state.since_accepted_s);
    if (accepted) {
      accept(state, settings, sample, step);
    } else {
      extrapolate(state, dt_s);
    }
  }
  uint32_t faults = 0;
  if (state.bad_in_a_row >= kBadInARow || count_bits(state.bad_history) >= kBadOf32 ||
      !state.started) {
    faults |= kEncoderFault;
  }
  if (!clamp_to_workspace(state.position_m, settings)) faults |= kWorkspaceFault;
  // Axis by axis: GCC clears a result first into which whole vectors are copied.
  const math::Vec3 at = state.position_m, v = state.velocity_mps;
  return {{at.x, at.y, at.z}, {v.x, v.y, v.z}, faults, accepted, state.started};
}

void clear(State& state) {
  state.bad_in_a_row = 0;
  state.bad_history = 0;
}

}  // namespace firmtouch::device
