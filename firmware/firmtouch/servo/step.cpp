#include "firmtouch/servo/step.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/guide_line.hpp"
#include "firmtouch/servo/proxy_spring.hpp"

namespace firmtouch::servo {
namespace {

using math::Vec3;

constexpr float kRound = 0x1p-24f;
// Far below what a motor driver resolves; below it, squares would lose digits to underflow.
constexpr float kMinLimit_N = 1e-9f;

bool is_on(Mode mode) { return mode == Mode::kRampIn || mode == Mode::kOn; }

bool is_sound(const Settings& settings) {
  return math::is_up_to(settings.force_limit_N, kMaxForceLimit_N) &&
         math::is_up_to(settings.slew_limit_N_per_s, kMaxSlewLimit_N_per_s) &&
         math::is_up_to(settings.ramp_in_s, 100.0f) && settings.tick_period_s >= 1e-5f &&
         math::is_up_to(settings.tick_period_s, kMaxTickPeriod_s) &&
         math::is_up_to(settings.energy.reservoir_J, kMaxReservoir_J) &&
         math::is_up_to(settings.energy.friction_N_per_m, kMaxStiffness_N_per_m);
}

// The share of a vector that `most` leaves: in exact arithmetic it is not longer then. noinline: in
// flash once.
[[gnu::noinline]] float share_within(Vec3 a, float most) {
  const float kept = most * (1.0f - 8.0f * kRound);
  const float is = math::length(a);
  if (is <= kept) return 1.0f;
  return most >= kMinLimit_N ? kept / is : 0.0f;
}

Vec3 shorten(Vec3 a, float most) { return a * share_within(a, most); }

// By which `a` is no longer than `wanted` along it.
[[gnu::noinline]] float share_along(Vec3 a, Vec3 wanted, float kept) {
  return share_within(a, math::dot(a, wanted) * kept / math::larger(math::length(a), FLT_MIN));
}

bool lasts(uint32_t ticks, const Settings& settings, float most_s = kLasting_s) {
  return static_cast<float>(ticks) * settings.tick_period_s >= most_s;
}

uint32_t seen_faults(const State& state, const Settings& settings, const LocalModel& model,
                     const StepInput& input) {
  uint32_t faults = input.reported;
  if (!is_sound(settings)) faults |= kFaultSettings;
  if (!math::is_within(input.position_m, kMaxPosition_m) ||
      !math::is_within(input.velocity_mps, kMaxVelocity_mps) ||
      !math::is_finite(state.force_N + state.part_N)) {
    faults |= kFaultNotFinite;
  }
  if (!is_sound(model)) faults |= kFaultModel;
  const float uncertain_s = state.mode == Mode::kOff ? kEnabling_s : kLasting_s;
  if (lasts(state.uncertain_ticks, settings, uncertain_s)) faults |= kFaultContact;
  if (model.is_squeezed) faults |= kFaultSqueezed;
  if (lasts(state.energy.overdrawn_ticks, settings)) faults |= kFaultEnergy;
  // The difference modulo 2^32, so that a tick counter that wraps is no event.
  if (static_cast<int32_t>(input.tick - model.expires_tick) > 0) faults |= kFaultStaleModel;
  return faults;
}

// noinline: in flash once, not twice.
__attribute__((noinline)) uint32_t ramp_out_ticks(const Settings& settings) {
  const float ticks = kRampOut_s / settings.tick_period_s;
  return ticks >= 1.0f && ticks <= 1000.0f ? static_cast<uint32_t>(ticks) : 1u;
}

void begin_ramp_out(State& state, const Settings& settings) {
  state.mode = Mode::kRampOut;
  state.part_N = state.force_N;
  state.ramp_out_left = ramp_out_ticks(settings);
}

void change_mode(State& state, const Settings& settings, bool enable) {
  if ((state.faults & kCutAtOnce) != 0) {
    state.mode = Mode::kFault;
  } else if (is_on(state.mode) && (state.faults != 0 || !enable)) {
    begin_ramp_out(state, settings);
  } else if (state.mode == Mode::kRampOut) {
    if (state.ramp_out_left == 0) state.mode = state.faults != 0 ? Mode::kFault : Mode::kOff;
  } else if (state.faults != 0) {
    state.mode = Mode::kFault;
  } else if (state.mode == Mode::kOff && enable && state.uncertain_ticks == 0) {
    state.mode = Mode::kRampIn;
    state.ramp_in_ticks = 0;
    state.part_N = {};
    state.energy.saved_J = state.guide_energy.saved_J = FLT_MAX;
  } else if (state.mode > Mode::kFault) {  // no such mode: memory was corrupted
    state.mode = Mode::kFault;
  }
}

Vec3 ramped_out(State& state, const Settings& settings) {
  if (state.ramp_out_left > 0) --state.ramp_out_left;
  const float share =
      static_cast<float>(state.ramp_out_left) / static_cast<float>(ramp_out_ticks(settings));
  return shorten(state.part_N * share, settings.force_limit_N);
}

// Moves the proxy, and counts the energy of the last tick. `is_late`: a model of an earlier tick
// begins, so that the spring's last stretch is another one: that of its ball, which the tool may
// have left.
// Result: the largest stretch of the spring.
float move_spring(State& state, const EnergySettings& counted, const ProxySpring& spring,
                  const Vec3& before_m, const Vec3& carried_m, bool is_late) {
  const Vec3& position_m = state.position_m;
  if (is_late) {
    const Vec3 last_m = position_m - state.move_m;
    state.energy.stretch_m = math::length(proxy_at(spring, last_m) - last_m);
  }
  state.has_proxy = spring.is_used;
  state.proxy_m = proxy_at(spring, position_m);
  return payable_stretch_m(state.energy, state.reservoir_J, counted,
                           spring.is_used ? spring.stiffness_N_per_m : 0.0f,
                           math::length(state.proxy_m - position_m), state.move_m, before_m,
                           math::dot(state.energy.force_N, carried_m));
}

// Counts the energy of the guide's last tick. `off_m`: of the tool, as far as the guide acts on it.
// Result: the share of its spring that is paid for.
float paid_share(State& state, const EnergySettings& counted, const LocalModel& model,
                 const Vec3& off_m, const Vec3& before_m, bool is_new) {
  Energy& energy = state.guide_energy;
  const float last_N_per_m = state.guide_N_per_m;
  const float stiffness = model.has_guide ? model.guide.stiffness_N_per_m : -1.0f;
  state.guide_N_per_m = stiffness;
  float is_m = 0;
  if (stiffness > 0.0f) {
    is_m = stretch_m(model.guide, off_m);
    if (!is_on(state.mode) || last_N_per_m < 0.0f) {  // takes hold
      energy.stretch_m = is_m;
      energy.saved_J += 0.5f * stiffness * is_m * is_m;
    } else {
      // The last tick's, from this model's line.
      if (is_new)
        energy.stretch_m =
            stretch_m(model.guide, guided_off_m(model.guide, state.position_m - state.move_m));
      if (stiffness > last_N_per_m) {  // the same force, and less energy
        energy.payable_m *= last_N_per_m / stiffness;
        const float stored_J = 0.5f * stiffness * energy.payable_m * energy.payable_m;
        energy.saved_J = math::smaller(energy.saved_J, stored_J - state.reservoir_J);
      }
    }
  }
  const float paid_m = payable_stretch_m(energy, state.reservoir_J, counted, stiffness, is_m,
                                         state.move_m, before_m);
  return paid_m < is_m ? paid_m / is_m : 1.0f;
}

float ramped_in(State& state, const Settings& settings) {
  if (state.mode == Mode::kOn) return 1.0f;
  const float ramp =
      static_cast<float>(++state.ramp_in_ticks) * settings.tick_period_s / settings.ramp_in_s;
  if (ramp < 1.0f) return ramp;
  state.mode = Mode::kOn;
  return 1.0f;
}

Vec3 rendered(State& state, const Settings& settings, const LocalModel& model,
              const StepInput& input, float spring_m, const Vec3& off_m, float guide_share) {
  const float share = ramped_in(state, settings);
  Vec3 other_N = planes_N(model, input.position_m, input.velocity_mps), guide_N;
  if (model.has_guide) {
    guide_N = pull_N(model.guide, off_m, input.velocity_mps, guide_share);
    other_N = other_N + guide_N + drive_N(model.guide, input.position_m, input.velocity_mps);
  }
  const Vec3 contact_N = spring_N(model.spring, state.proxy_m, spring_m, input.position_m,
                                  input.velocity_mps - model.spring.velocity_mps);
  const Vec3 model_N = (other_N + contact_N) * share;
  const float within = share_within(model_N, settings.force_limit_N);
  const Vec3 wanted_N = model_N * within;
  // The sum below rounds by half an ulp of an axis, at most the limit; subtracted from the step
  // here.
  const float step_N = settings.slew_limit_N_per_s * settings.tick_period_s -
                       settings.force_limit_N * (4.0f * kRound);
  const Vec3 change_N = wanted_N - state.force_N;
  const float moved = share_within(change_N, step_N);
  Vec3 force_N = shorten(state.force_N + change_N * moved, settings.force_limit_N);
  // The parts lag behind as their sum does, so that they add up to it.
  const float kept = within * share;
  Vec3& part_N = state.part_N;
  Vec3& its_N = state.guide_energy.force_N;
  part_N = part_N + (other_N * kept - part_N) * moved;
  its_N = its_N + (guide_N * kept - its_N) * moved;
  // A part that is not paid for must not last: all fall, faster than the slew limit, by as much as
  // it is to fall.
  float left = 1;
  if (state.energy.is_unpaid) left = share_along(force_N - part_N, contact_N, kept);
  if (state.guide_energy.is_unpaid) left = math::smaller(left, share_along(its_N, guide_N, kept));
  force_N = force_N * left;
  part_N = part_N * left;
  its_N = its_N * left;
  if (model.spring.is_used) state.energy.force_N = force_N - state.part_N;
  return force_N;
}

}  // namespace

StepOutput step(State& state, const Settings& settings, const LocalModel& model,
                const StepInput& input) {
  if (input.clear_faults && !input.enable) {
    state = State{};
  }
  // In the ticks that enable, the motors count as on already: a fault that stands keeps them off.
  const bool counts = is_on(state.mode) || (input.enable && state.mode == Mode::kOff);
  state.uncertain_ticks = model.is_uncertain && counts ? state.uncertain_ticks + 1 : 0;
  // The device's friction counts once, and fills the reservoir of both: with contact, if there is.
  const EnergySettings without{settings.energy.reservoir_J, 0};
  const EnergySettings& of_contact = model.spring.is_used ? settings.energy : without;
  const EnergySettings& of_guide = model.spring.is_used ? without : settings.energy;
  const Vec3 before_m = state.move_m;
  state.move_m = input.position_m - state.position_m;
  state.position_m = input.position_m;
  const Vec3 carried_m = model.spring.velocity_mps * settings.tick_period_s;
  const bool is_new = model.made_tick != state.made_tick;
  state.made_tick = model.made_tick;
  const float spring_m = move_spring(state, of_contact, model.spring, before_m, carried_m,
                                     is_new && model.made_tick != input.tick);
  const Vec3 off_m = model.has_guide ? guided_off_m(model.guide, input.position_m) : Vec3{};
  const float guide_share = paid_share(state, of_guide, model, off_m, before_m, is_new);
  uint32_t faults = seen_faults(state, settings, model, input);
  if (!counts) faults &= ~kOnlyWhileOn;
  state.faults |= faults;
  change_mode(state, settings, input.enable);

  state.energy.force_N = {};
  if (!is_on(state.mode)) state.guide_energy.force_N = {};
  Vec3 force_N;
  if (is_on(state.mode)) {
    force_N = rendered(state, settings, model, input, spring_m, off_m, guide_share);
  } else if (state.mode == Mode::kRampOut) {
    force_N = ramped_out(state, settings);
  }
  if (!math::is_finite(force_N)) {
    state.faults |= kFaultNotFinite;
    state.mode = Mode::kFault;
    force_N = {};
  }
  state.force_N = force_N;

  StepOutput output;
  output.force_N = force_N;
  output.proxy_m = state.proxy_m;
  output.mode = state.mode;
  output.faults = state.faults;
  return output;
}

}  // namespace firmtouch::servo
