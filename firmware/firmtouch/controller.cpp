#include "firmtouch/controller.hpp"

#include "firmtouch/servo/fault.hpp"

namespace firmtouch {
namespace {

using params::Values;

device::Settings device_settings(const Values& v) {
  return {{v[params::kCountsPerMetreX], v[params::kCountsPerMetreY], v[params::kCountsPerMetreZ]},
          {v[params::kOriginX], v[params::kOriginY], v[params::kOriginZ]},
          {v[params::kWorkspaceHalfX], v[params::kWorkspaceHalfY], v[params::kWorkspaceHalfZ]},
          v[params::kMaxSpeed],
          v[params::kVelocityFilter]};
}

servo::Settings servo_settings(const Values& v) {
  return {v[params::kForceLimit], v[params::kSlewLimit], v[params::kRampIn],
          v[params::kTickPeriod]};
}

// The guard's ceilings are its own words, and mean the table's.
static_assert(servo::kGuardMaxForce_N >= params::kMaxForceLimit_N &&
              servo::kGuardMaxForce_N <= servo::kMaxForceLimit_N &&
              servo::kMaxForceLimit_N <= params::kMaxForceLimit_N);
static_assert(servo::kGuardMaxSlew_N_per_s >= params::kMaxSlewLimit_N_per_s &&
              servo::kGuardMaxSlew_N_per_s <= servo::kMaxSlewLimit_N_per_s &&
              servo::kMaxSlewLimit_N_per_s <= params::kMaxSlewLimit_N_per_s);
static_assert(servo::kGuardMaxPeriod_s >= params::kMaxTickPeriod_s &&
              servo::kGuardMaxPeriod_s <= servo::kMaxTickPeriod_s &&
              servo::kMaxTickPeriod_s <= params::kMaxTickPeriod_s);

// The guard takes the one limit that the command names, from the command: the parameters' memory is
// what it guards against.
void tell_guard(servo::GuardState& guard, uint32_t row, float value) {
  servo::GuardLimits limits = guard_limits(guard);
  if (row == params::kForceLimit) limits.force_limit_N = value;
  if (row == params::kSlewLimit) limits.slew_limit_N_per_s = value;
  if (row == params::kTickPeriod) limits.tick_period_s = value;
  guard_set_limits(guard, limits);
}

// A drive does not catch up with more than that: the tick counter was set otherwise.
constexpr uint32_t kMaxTicksOfAModel = 1000;

query::Budget budget(const Values& v, params::Index row) { return {static_cast<uint32_t>(v[row])}; }

math::RigidTransform scene_pose(const Values& v) {
  return {{}, {v[params::kSceneX], v[params::kSceneY], v[params::kSceneZ]}};
}

uint32_t device_faults(uint32_t faults) {
  return ((faults & device::kEncoderFault) != 0 ? servo::kFaultEncoder : 0u) |
         ((faults & device::kWorkspaceFault) != 0 ? servo::kFaultWorkspace : 0u);
}

uint32_t line_faults(uint32_t lines) {
  return ((lines & record::kFlagDriveFault) != 0 ? servo::kFaultDrive : 0u) |
         ((lines & record::kFlagEmergencyStop) != 0 ? servo::kFaultEmergencyStop : 0u);
}

uint32_t asset_faults(const Opener& opener) {
  if (!opener.is_refused()) return 0;
  return opener.verdict().rule >= kRuleArithmetic ? servo::kFaultProbes : servo::kFaultAsset;
}

void put(float (&to)[record::kAxes], math::Vec3 from) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

}  // namespace

void Controller::begin(core::Bytes asset, Selection selection) {
  opener_.begin(asset, selection);
  reset();
}

void Controller::reset() {
  live_ = Live{};
  const Values& v = live_.values;
  guard_set_limits(live_.guard,
                   {v[params::kForceLimit], v[params::kSlewLimit], v[params::kTickPeriod]});
}

core::Verdict Controller::open(core::Bytes asset, Selection selection) {
  begin(asset, selection);
  while (!work(4096)) {
  }
  return verdict();
}

bool Controller::take_parameter(const record::TickInput& input) {
  const uint32_t row = input.command - 1;
  if (row >= params::kCount) return false;
  const bool motors_off =
      live_.servo.mode == servo::Mode::kOff || live_.servo.mode == servo::Mode::kFault;
  const bool enable = (input.flags & record::kFlagEnable) != 0;
  if (enable || !motors_off) {
    const params::When when = params::kTable[row].when;
    if (when == params::When::kMotorsOff) return false;
    if (when == params::When::kMayFall && !(input.command_value <= live_.values.value[row]))
      return false;
  }
  if (!params::set(live_.values, row, input.command_value)) return false;
  tell_guard(live_.guard, row, input.command_value);
  return true;
}

Controller::Surface Controller::touch(const Wish& wish, const Values& v, servo::LocalModel& model) {
  Geometry& g = live_.geometry;
  const scene::Material material = {v[params::kContactStiffness], v[params::kContactDamping]};
  if (opener_.spline_surface().is_open()) {
    scene::SplineObject object;
    object.surface = &opener_.spline_surface();
    object.pose = scene_pose(v);
    object.material = material;
    object.is_turned = v[params::kSurfaceTurned] >= 0.5f;
    object.is_closed = v[params::kSurfaceClosed] >= 0.5f;
    scene::touch_spline(object, v[params::kToolRadius], wish.position_m,
                        budget(v, params::kMeshSteps), g.spline, model);
    const spline::Closest& closest = g.spline.closest;
    const bool is_inside = closest.certificate.sign < 0;
    return {is_inside ? -closest.distance_m : closest.distance_m, g.spline.penetration_m,
            closest.certificate, closest.certificate.steps, false};
  }
  scene::MeshObject object;
  object.mesh = &opener_.mesh();
  object.distance_field = &opener_.distance_field();
  object.base_hull = &opener_.hull().base_hull();
  object.pose = scene_pose(v);
  object.material = material;
  scene::touch_mesh(object, v[params::kToolRadius], wish.position_m, budget(v, params::kMeshSteps),
                    g.touch, model);
  return {g.touch.closest.distance_m, g.touch.penetration_m, g.touch.closest.certificate,
          g.touch.closest.certificate.steps + g.touch.base_hull_steps, g.touch.is_of_base_hull};
}

void Controller::feel(const Wish& wish, const Values& v, Felt& felt) {
  Geometry& g = live_.geometry;
  // The drive of a guide goes on by the time since the model before, at one rate a tick.
  const uint32_t passed = wish.tick - g.tick;
  const uint32_t ticks = g.sequence != 0 && passed <= kMaxTicksOfAModel ? passed : 1;
  g.tick = wish.tick;
  felt.model.sequence = g.sequence;
  scene::begin_model(felt.model, wish.position_m, wish.tick,
                     static_cast<uint32_t>(v[params::kModelAge]));
  g.sequence = felt.model.sequence;
  Surface surface;
  if (wish.can_feel) {
    surface = touch(wish, v, felt.model);
    scene::CurveGuide guide;
    guide.curve = &opener_.curve();
    guide.spline = &opener_.spline_guide();
    guide.pose = scene_pose(v);
    guide.material = {v[params::kGuideStiffness], v[params::kGuideDamping]};
    guide.snap_m = v[params::kGuideSnap];
    guide.release_m = v[params::kGuideRelease];
    guide.tunnel_m = v[params::kGuideTunnel];
    guide.arc_penalty = v[params::kGuideArcPenalty];
    guide.free_side = {v[params::kGuideSideX], v[params::kGuideSideY], v[params::kGuideSideZ]};
    guide.ends = static_cast<scene::Ends>(static_cast<uint8_t>(v[params::kGuideEnds]));
    guide.drive = {static_cast<scene::Drive::Kind>(static_cast<uint8_t>(v[params::kGuideDrive])),
                   v[params::kGuideDriveForce], v[params::kGuideDriveSpeed],
                   static_cast<float>(ticks) * v[params::kTickPeriod]};
    scene::follow_curve(guide, wish.position_m, budget(v, params::kCurveSteps), g.guide,
                        felt.model);
  }
  const curve::Closest& line = g.guide.closest;
  felt.distance_m = surface.distance_m;
  felt.distance_lower_m = surface.certificate.lower_m;
  felt.penetration_m = surface.penetration_m;
  felt.guide_deviation_m = line.distance_m;
  felt.guide_lower_m = line.certificate.lower_m;
  felt.guide_arc = line.arc;
  felt.steps = surface.steps + line.certificate.steps;
  felt.guide_steps = line.certificate.steps;
  felt.state = static_cast<uint32_t>(surface.certificate.sign + 1) << record::kStateSignShift;
  if (surface.penetration_m > 0) felt.state |= record::kStateContact;
  if (surface.is_of_base_hull) felt.state |= record::kStateOfBaseHull;
  if (g.guide.is_held) felt.state |= record::kStateOnGuide;
  if (surface.certificate.exact) felt.state |= record::kStateExact;
  if (line.certificate.exact) felt.state |= record::kStateGuideExact;
}

// The model of this tick, made in it or elsewhere.
const Controller::Felt& Controller::felt_in(const Wish& wish, uint32_t lines) {
  if ((lines & record::kFlagModelApart) == 0) {
    feel(wish, live_.values, live_.models.answer());
    return live_.models.answer();
  }
  if ((lines & record::kFlagModelTaken) != 0) live_.models.take();
  if ((lines & record::kFlagModelWanted) != 0) live_.models.ask({wish, live_.values});
  return live_.models.answer();
}

uint32_t Controller::model_flags() const {
  uint32_t lines = record::kFlagModelApart;
  if (live_.models.is_made()) lines |= record::kFlagModelTaken | record::kFlagModelWanted;
  if (live_.models.is_idle()) lines |= record::kFlagModelWanted;
  return lines;
}

void Controller::make_model() {
  const Question* question = live_.models.asked();
  if (question == nullptr) return;
  feel(question->wish, question->values, live_.models.draft());
  live_.models.made();
}

void Controller::tell(const Felt& felt, record::TickOutput& output) {
  output.distance_m = felt.distance_m;
  output.distance_lower_m = felt.distance_lower_m;
  output.penetration_m = felt.penetration_m;
  output.guide_deviation_m = felt.guide_deviation_m;
  output.guide_lower_m = felt.guide_lower_m;
  output.guide_arc = felt.guide_arc;
  output.steps = felt.steps;
  output.guide_steps = felt.guide_steps;
  output.state |= felt.state;
  output.model_sequence = felt.model.sequence;
}

void Controller::tick(const record::TickInput& input, record::TickOutput& output) {
  const bool ready = opener_.is_ready();
  const bool enable = (input.flags & record::kFlagEnable) != 0;
  if (!enable && ready) live_.enable_was_low = true;
  const bool clear = input.command == record::kCommandClearFaults && !enable;
  output = {};
  if (clear) {
    forgive(live_.clock);
    forgive(live_.device);
    guard_clear(live_.guard);
  }
  if (input.command != record::kCommandNone) {
    const bool taken = clear || take_parameter(input);
    output.state |= taken ? record::kStateCommandTaken : record::kStateCommandRefused;
  }
  const Values& v = live_.values;

  const servo::ClockReading clock =
      watch_clock(live_.clock, input.clock_us, v[params::kTickPeriod], v[params::kLateRatio]);
  const device::Sample sample{
      {input.encoder_counts[0], input.encoder_counts[1], input.encoder_counts[2]},
      (input.flags & record::kFlagEncoderFault) == 0,
      clock.dt_s};
  const device::Reading tool = read(live_.device, device_settings(v), sample);

  const Felt& felt = felt_in({tool.position_m, input.tick, ready && tool.started}, input.flags);

  servo::StepInput step;
  step.position_m = tool.position_m;
  step.velocity_mps = tool.velocity_mps;
  step.tick = input.tick;
  step.enable = enable && ready && live_.enable_was_low;
  step.clear_faults = clear;
  step.reported = clock.faults | device_faults(tool.faults) | line_faults(input.flags);
  if (enable) step.reported |= asset_faults(opener_);
  const servo::StepOutput wanted = servo::step(live_.servo, servo_settings(v), felt.model, step);

  // A Cartesian device's joints are its axes: the force of each motor is the tool's.
  float motor_N[record::kAxes];
  put(motor_N, wanted.force_N);
  const bool cut = line_faults(input.flags) != 0 || (wanted.faults & servo::kCutAtOnce) != 0;
  if (!guard(live_.guard, step.enable && wanted.faults == 0, cut, motor_N)) {
    live_.servo.faults |= servo::kFaultGuard;
    live_.servo.mode = servo::Mode::kFault;
  }
  for (uint32_t k = 0; k < record::kAxes; ++k) output.motor_N[k] = output.force_N[k] = motor_N[k];
  put(output.position_m, tool.position_m);
  put(output.velocity_mps, tool.velocity_mps);
  output.faults = live_.servo.faults;
  output.state |= static_cast<uint32_t>(live_.servo.mode) | (ready ? record::kStateReady : 0u);
  tell(felt, output);
}

}  // namespace firmtouch
