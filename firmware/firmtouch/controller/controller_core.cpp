#include "firmtouch/controller/controller_core.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/proxy_spring.hpp"

namespace firmtouch {
namespace {

using params::Values;

servo::Settings servo_settings(const Values& v) {
  return {v[params::kForceLimit],
          v[params::kSlewLimit],
          v[params::kRampIn],
          v[params::kTickPeriod],
          {v[params::kEnergyReservoir], v[params::kDeviceDamping] / v[params::kTickPeriod]}};
}

// The guard has its own constants for the table's ceilings.
static_assert(servo::kGuardMaxForce_N >= params::kMaxForceLimit_N &&
              servo::kGuardMaxForce_N <= servo::kMaxForceLimit_N &&
              servo::kMaxForceLimit_N <= params::kMaxForceLimit_N);
static_assert(servo::kGuardMaxSlew_N_per_s >= params::kMaxSlewLimit_N_per_s &&
              servo::kGuardMaxSlew_N_per_s <= servo::kMaxSlewLimit_N_per_s &&
              servo::kMaxSlewLimit_N_per_s <= params::kMaxSlewLimit_N_per_s);
static_assert(servo::kGuardMaxPeriod_s >= params::kMaxTickPeriod_s &&
              servo::kGuardMaxPeriod_s <= servo::kMaxTickPeriod_s &&
              servo::kMaxTickPeriod_s <= params::kMaxTickPeriod_s);

// record::may_push() and may_move() rely on the numbers of these modes.
static_assert(static_cast<uint32_t>(servo::Mode::kRampIn) == 1 &&
              static_cast<uint32_t>(servo::Mode::kOn) == 2 &&
              static_cast<uint32_t>(servo::Mode::kRampOut) == 3);

// The guard takes a limit from the command that changes it, not from the parameters' memory, which
// it guards against.
void set_guard_limit(servo::GuardState& guard, uint32_t number, float value) {
  servo::GuardLimits limits = guard_limits(guard);
  if (number == params::kForceLimit) limits.force_limit_N = value;
  if (number == params::kSlewLimit) limits.slew_limit_N_per_s = value;
  if (number == params::kTickPeriod) limits.tick_period_s = value;
  guard_set_limits(guard, limits);
}

// A longer pause between two models is a jump of the tick counter: a drive does not catch up.
constexpr uint32_t kMaxTicksOfAModel = 1000;

uint32_t device_faults(uint32_t faults) {
  return ((faults & device::kEncoderFault) != 0 ? servo::kFaultEncoder : 0u) |
         ((faults & device::kWorkspaceFault) != 0 ? servo::kFaultWorkspace : 0u);
}

uint32_t flag_faults(uint32_t flags) {
  return ((flags & record::kFlagDriveFault) != 0 ? servo::kFaultDrive : 0u) |
         ((flags & record::kFlagEmergencyStop) != 0 ? servo::kFaultEmergencyStop : 0u);
}

bool is_on(servo::Mode mode) { return mode == servo::Mode::kRampIn || mode == servo::Mode::kOn; }

void put(float (&to)[record::kAxes], math::Vec3 from) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

// noinline: in flash once.
[[gnu::noinline]] void correct(servo::Energy& energy, const Rendered& last) {
  energy.force_N = energy.force_N * last.share;
  float saved_J = energy.saved_J - math::dot(energy.force_N, last.off_m);
  if (energy.stretch_m > 0.0f || energy.is_unpaid)  // in contact, or left unpaid
    saved_J -= servo::kHiddenWork_per_J * last.hidden_J2;
  energy.saved_J = saved_J;
}

}  // namespace

void ControllerCore::reset() {
  live_ = Live{};
  params::set_initial(values_, table_);
  models_.reset();
  const Values& v = values_;
  guard_set_limits(live_.guard,
                   {v[params::kForceLimit], v[params::kSlewLimit], v[params::kTickPeriod]});
}

bool ControllerCore::set_parameter(const record::TickInput& input) {
  const uint32_t row = input.command - 1;
  if (row >= table_.size()) return false;
  const params::Entry& entry = table_[row];
  const bool motors_off =
      live_.servo.mode == servo::Mode::kOff || live_.servo.mode == servo::Mode::kFault;
  const bool enable = (input.flags & record::kFlagEnable) != 0;
  if (enable || !motors_off) {
    if (entry.when == params::When::kMotorsOff) return false;
    if (entry.when == params::When::kMayFall && !(input.command_value <= values_[entry.number]))
      return false;
  }
  if (!params::set(values_, table_, row, input.command_value)) return false;
  set_guard_limit(live_.guard, entry.number, input.command_value);
  return true;
}

ControllerCore::Tick ControllerCore::begin_tick(const record::TickInput& input,
                                                const AssetStatus& asset,
                                                record::TickOutput& output) {
  const bool enable = (input.flags & record::kFlagEnable) != 0;
  if (!enable && asset.is_ready) live_.enable_was_low = true;
  const bool clear = input.command == record::kCommandClearFaults && !enable;
  output.state = 0;
  if (clear) {
    servo::clear(live_.clock);
    guard_clear(live_.guard);
  }
  if (input.command != record::kCommandNone) {
    const bool taken = clear || set_parameter(input);
    output.state |= taken ? record::kStateCommandTaken : record::kStateCommandRefused;
  }
  const Values& v = values_;

  const servo::ClockReading clock = watch_clock(live_.clock, input.clock_us, input.last_work_us,
                                                v[params::kTickPeriod], v[params::kLateRatio]);
  Tick tick;
  tick.sample = {{input.encoder_counts[0], input.encoder_counts[1], input.encoder_counts[2]},
                 (input.flags & record::kFlagEncoderFault) == 0,
                 clock.dt_s};
  tick.step.reported = clock.faults | flag_faults(input.flags);
  // An overloaded controller queries nothing, so that the main loop, and with it the link, goes on.
  const bool is_overloaded = ((live_.servo.faults | clock.faults) & servo::kFaultOverload) != 0;
  tick.request.tick = tick.step.tick = input.tick;
  tick.request.can_touch = asset.is_ready && !is_overloaded;
  tick.request.is_on = is_on(live_.servo.mode);
  tick.request.has_proxy = live_.servo.has_proxy;
  tick.request.proxy_m = live_.servo.proxy_m;
  tick.step.enable = enable && asset.is_ready && live_.enable_was_low;
  tick.step.clear_faults = clear;
  if (enable) tick.step.reported |= asset.faults;
  return tick;
}

void ControllerCore::locate(const device::Reading& tool, Tick& tick) {
  tick.request.position_m = tick.step.position_m = tool.position_m;
  tick.request.can_touch = tick.request.can_touch && tool.started;
  tick.step.velocity_mps = tool.velocity_mps;
  tick.step.reported |= device_faults(tool.faults);
}

void ControllerCore::begin_model(const ModelRequest& request, const Values& v,
                                 ModelResult& result) {
  const uint32_t passed = request.tick - live_.model_tick;
  result.ticks = live_.model_sequence != 0 && passed <= kMaxTicksOfAModel ? passed : 1;
  live_.model_tick = request.tick;
  result.distance_m = result.distance_lower_m = result.penetration_m = 0;
  result.guide_deviation_m = result.guide_lower_m = result.guide_arc = 0;
  result.steps = result.guide_steps = 0;
  result.work_left = static_cast<uint32_t>(v[params::kTickWork] - params::kFixedTickWork);
  result.state = 1u << record::kStateSignShift;
  result.model.sequence = live_.model_sequence;
  scene::begin_model(result.model, request.position_m, request.tick,
                     static_cast<uint32_t>(v[params::kModelAge]));
  live_.model_sequence = result.model.sequence;
}

ModelResult* ControllerCore::result_of_tick(Tick& tick, uint32_t flags) {
  if ((flags & record::kFlagModelApart) == 0) return &models_.result();
  if ((flags & record::kFlagModelTaken) != 0) models_.take();
  if ((flags & record::kFlagModelWanted) != 0 && models_.is_idle()) {
    // Where this tick's model will have it: the last tick's proxy is of another ball.
    const servo::ProxySpring& spring = models_.result().model.spring;
    tick.request.has_proxy = spring.is_used;
    tick.request.proxy_m = servo::proxy_at(spring, tick.request.position_m);
    ModelTask& task = models_.request_draft();
    task.request = tick.request;
    task.values = values_;
    models_.request();
  }
  return nullptr;
}

uint32_t ControllerCore::model_flags() const {
  uint32_t flags = record::kFlagModelApart;
  if (models_.is_made()) flags |= record::kFlagModelTaken | record::kFlagModelWanted;
  if (models_.is_idle()) flags |= record::kFlagModelWanted;
  return flags;
}

void ControllerCore::count_rendered(const Rendered& last) {
  const bool as_counted = !(last.share < 1.0f) && !(last.hidden_J2 > 0.0f) &&
                          !(math::dot(last.off_m, last.off_m) > 0.0f);
  if (as_counted) return;
  correct(live_.servo.energy, last);
  correct(live_.servo.guide_energy, last);
}

Push ControllerCore::step(const Tick& tick, uint32_t flags, record::TickOutput& output) {
  const servo::StepOutput wanted =
      servo::step(live_.servo, servo_settings(values_), models_.result().model, tick.step);
  put(output.proxy_m, wanted.proxy_m);
  // What neither end_tick() nor every device writes.
  for (uint32_t k = 0; k < record::kAxes; ++k)
    output.motor_N[k] = output.force_N[k] = output.torque_Nm[k] = 0;
  Push push;
  push.force_N = wanted.force_N;
  push.is_on = is_on(wanted.mode);
  push.may_push = tick.step.enable && wanted.faults == 0;
  push.cut = flag_faults(flags) != 0 || (wanted.faults & servo::kCutAtOnce) != 0;
  return push;
}

void ControllerCore::end_tick(const AssetStatus& asset, const Tick& tick, bool passed,
                              record::TickOutput& output) {
  const ModelResult& result = models_.result();
  if (!passed) {
    live_.servo.faults |= servo::kFaultGuard;
    live_.servo.mode = servo::Mode::kFault;
  }
  put(output.position_m, tick.step.position_m);
  put(output.velocity_mps, tick.step.velocity_mps);
  output.faults = live_.servo.faults;
  output.state |= result.state | static_cast<uint32_t>(live_.servo.mode) |
                  (asset.is_ready ? record::kStateReady : 0u) |
                  (result.model.is_uncertain ? record::kStateUncertain : 0u);
  output.distance_m = result.distance_m;
  output.distance_lower_m = result.distance_lower_m;
  output.penetration_m = result.penetration_m;
  output.guide_deviation_m = result.guide_deviation_m;
  output.guide_lower_m = result.guide_lower_m;
  output.guide_arc = result.guide_arc;
  output.steps = result.steps;
  output.guide_steps = result.guide_steps;
  output.model_sequence = result.model.sequence;
}

}  // namespace firmtouch
