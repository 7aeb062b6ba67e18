#include "host_sim/trace/run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <sstream>

#include "firmtouch/params/table.hpp"
#include "firmtouch/servo/step.hpp"
#include "host_sim/hand/arm.hpp"
#include "host_sim/hand/hand.hpp"
#include "host_sim/hand/palm.hpp"
#include "host_sim/plant/machine.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kMaxTicks = 1000000000;  // 28 h at 10 kHz; record numbers stay below 2^32
constexpr uint32_t kSettlingTicks = 5;  // between the last initial parameter and the enable line
constexpr double kReach_s = 1;          // of the hand, from where a linkage was homed
constexpr uint64_t kJitterStream = 1ull << 40;  // beside that of the encoders' noise
constexpr double kMaxWait_s = 10;               // by which homing and reaching lengthen a run

constexpr params::Index kCountsPerMetre[3] = {params::kCountsPerMetreX, params::kCountsPerMetreY,
                                              params::kCountsPerMetreZ};
constexpr params::Index kOrigin[3] = {params::kOriginX, params::kOriginY, params::kOriginZ};

bool is_set(const Scenario& scenario, uint32_t parameter) {
  return std::any_of(scenario.settings.begin(), scenario.settings.end(),
                     [&](const Setting& s) { return s.parameter == parameter; });
}

// Ticks from one local model to the next; 0: every tick makes its own.
uint32_t model_ticks(const Scenario& scenario) {
  return scenario.geometry_rate_Hz > 0
             ? static_cast<uint32_t>(
                   std::max(1.0, std::round(scenario.rate_Hz / scenario.geometry_rate_Hz)))
             : 0;
}

// One parameter is set per tick; models in progress still use the previous values.
size_t setup_ticks(const Scenario& scenario) {
  return scenario.settings.size() + kSettlingTicks + 3 * size_t{model_ticks(scenario)};
}

// Flags and command of each tick, from the scenario's settings and events.
class Operator {
 public:
  Operator(const Scenario& scenario, const Environment& environment) : scenario_(scenario) {
    for (const Setting& setting : scenario.settings) commands_.push_back(setting);
    enable_tick_ = static_cast<uint32_t>(setup_ticks(scenario));
    for (const PlacedMesh& placed : environment.meshes()) objects_.push_back(placed.name);
    for (const Event& event : scenario.events)
      if (event.kind == Event::Kind::kMoveObject)
        check_object(event.object);
      else if (event.kind == Event::Kind::kSet)
        check_stands(event.parameter);
  }
  // `last`: output of the tick before.
  void fill(record::TickInput& input, const record::TickOutput& last, double time_s) {
    uint32_t once = 0;
    for (; next_ < scenario_.events.size() && scenario_.events[next_].time_s <= time_s; ++next_)
      once |= apply(scenario_.events[next_]);
    if (last.steps > 0 && load_ > 0)
      input.last_work_us = static_cast<uint32_t>(std::lround(load_ * 1e6 / scenario_.rate_Hz));
    const bool enabled = enabled_ && input.tick >= enable_tick_;
    input.flags = held_ | once | (enabled ? record::kFlagEnable : 0);
    if (commands_.empty()) return;
    input.command = 1 + commands_.front().parameter;
    input.command_value = static_cast<float>(commands_.front().value);
    commands_.pop_front();
  }

 private:
  // Result: flags of this tick only.
  uint32_t apply(const Event& event) {
    switch (event.kind) {
      case Event::Kind::kEmergencyStop:
        held_ |= record::kFlagEmergencyStop;
        return 0;
      case Event::Kind::kDriveFault:
        held_ |= record::kFlagDriveFault;
        return 0;
      case Event::Kind::kEncoderFault:
        return record::kFlagEncoderFault;
      case Event::Kind::kDisable:
        enabled_ = false;
        return 0;
      case Event::Kind::kEnable:
        enabled_ = true;
        return 0;
      case Event::Kind::kRelease:
        held_ = 0;
        return 0;
      case Event::Kind::kClearFaults:
        commands_.push_back({record::kCommandClearFaults - 1, 0});
        return 0;
      case Event::Kind::kSet:
        commands_.push_back({event.parameter, event.value});
        return 0;
      case Event::Kind::kLoad:
        load_ = event.value;
        return 0;
      case Event::Kind::kMoveObject:
        commands_.push_back(
            {record::kCommandMoveObject + number_of(event.object) - 1, event.value});
        return 0;
      case Event::Kind::kTurnTool:
        commands_.push_back({record::kCommandTurnTool + event.parameter - 1, event.value});
        return 0;
      case Event::Kind::kFail:
        return 0;
    }
    return 0;
  }
  uint32_t number_of(const std::string& object) const {
    return static_cast<uint32_t>(std::find(objects_.begin(), objects_.end(), object) -
                                 objects_.begin());
  }
  // Oracles and charts know one place of the scene.
  void check_stands(uint32_t parameter) const {
    for (const params::Index of_scene :
         {params::kSceneX, params::kSceneY, params::kSceneZ, params::kSurfaceTurned})
      if (parameter == of_scene)
        throw Refused(scenario_.file + ": `set " + params::kTable[parameter].name +
                      "`: the simulated scene stands; give its place without `at`");
  }
  void check_object(const std::string& object) const {
    const std::string place = scenario_.file + ": `move " + object + "`: ";
    if (scenario_.geometry_rate_Hz > 0)
      throw Refused(place + "at two rates objects stand; leave out `geometry_rate`");
    if (number_of(object) < objects_.size()) return;
    std::string list;
    for (const std::string& name : objects_)
      if (!name.empty()) list += (list.empty() ? "`" : ", `") + name + "`";
    throw Refused(place + "the asset has no such object; " +
                  (list.empty() ? "it has none that is touched" : "it has: " + list));
  }

  const Scenario& scenario_;
  std::vector<std::string> objects_;
  std::deque<Setting> commands_;
  uint32_t enable_tick_ = 0;
  size_t next_ = 0;
  uint32_t held_ = 0;
  double load_ = 0;
  bool enabled_ = true;
};

void check_command(const Scenario& scenario, const record::TickRecord& record) {
  if ((record.output.state & record::kStateCommandRefused) == 0) return;
  if (record.input.command == record::kCommandClearFaults)
    throw Refused(scenario.file + ": at tick " + std::to_string(record.input.tick) +
                  " the controller rejects clear_faults, which it accepts only while disabled; put "
                  "`at T s disable` before it");
  if (record.input.command >= record::kCommandTurnTool &&
      record.input.command < record::kCommandMoveObject)
    throw Refused(scenario.file + ": at tick " + std::to_string(record.input.tick) +
                  " the controller rejects `turn`: the asset has no tool of spheres, or "
                  "`geometry_rate` makes the models: then the handle keeps its orientation");
  const params::Entry& row = params::kTable[record.input.command - 1];
  std::ostringstream value;
  value << record.input.command_value;
  throw Refused(scenario.file + ": at tick " + std::to_string(record.input.tick) +
                " the controller rejects " + row.name + " = " + value.str() + " " + row.unit +
                (row.when == params::When::kMotorsOff
                     ? "; this parameter may change only while the motors are off"
                 : row.when == params::When::kMayFall
                     ? "; it is out of range, or a raise while the motors are on"
                     : "; it is out of range"));
}

// At two rates: each model is complete when the next one is requested.
uint32_t model_flags(const Scenario& scenario, uint32_t tick) {
  const uint32_t every = model_ticks(scenario);
  if (every == 0) return 0;
  if (tick % every != 0) return record::kFlagModelApart;
  return record::kFlagModelApart | record::kFlagModelTaken | record::kFlagModelWanted;
}

uint32_t tick_count(const Scenario& scenario, const Hand& hand) {
  const double seconds = scenario.duration_s > 0 ? scenario.duration_s : hand.end_s();
  const double ticks = std::round(seconds * scenario.rate_Hz);
  if (ticks > kMaxTicks)
    throw Refused(scenario.file + ": " + std::to_string(static_cast<uint64_t>(ticks)) +
                  " ticks are more than " + std::to_string(kMaxTicks) +
                  "; shorten the duration or lower the rate");
  return static_cast<uint32_t>(std::max(ticks, 1.0));
}

}  // namespace

bool motors_are_on(const record::TickOutput& output) {
  const uint32_t mode = output.state & record::kStateServoMask;
  return mode == static_cast<uint32_t>(servo::Mode::kRampIn) ||
         mode == static_cast<uint32_t>(servo::Mode::kOn);
}

double parameter_value(const Scenario& scenario, uint32_t parameter) {
  for (const Setting& setting : scenario.settings)
    if (setting.parameter == parameter) return setting.value;
  return static_cast<double>(params::kTable[parameter].initial);
}

Vec scene_origin_m(const Scenario& scenario) {
  return {parameter_value(scenario, params::kSceneX), parameter_value(scenario, params::kSceneY),
          parameter_value(scenario, params::kSceneZ)};
}

void complete(Scenario& scenario) {
  // First: until it is taken, ticks that come sooner than the initial period are counted as early.
  if (!is_set(scenario, params::kTickPeriod))
    scenario.settings.insert(scenario.settings.begin(),
                             {params::kTickPeriod, 1 / scenario.rate_Hz});
  // A model is one period old when it is first used, and two when the next one replaces it.
  const uint32_t every = model_ticks(scenario);
  if (every > 1 && !is_set(scenario, params::kModelAge))
    scenario.settings.push_back({params::kModelAge, 2.0 * every + 1});
  if (scenario.device.encoder_quantum_m > 0) {
    for (const params::Index axis : kCountsPerMetre)
      if (!is_set(scenario, axis))
        scenario.settings.push_back({axis, 1 / scenario.device.encoder_quantum_m});
  } else {
    scenario.device.encoder_quantum_m = 1 / parameter_value(scenario, params::kCountsPerMetreX);
  }
}

struct Simulation::Loop {
  Loop(const Scenario& its_scenario, Tick its_controller, const Environment& environment,
       LockStepController* its_remote)
      : scenario(its_scenario),
        controller(std::move(its_controller)),
        remote(its_remote),
        hand(scenario, environment, parameter_value(scenario, params::kToolRadius)),
        machine(scenario, hand.start_m(),
                {parameter_value(scenario, kOrigin[0]), parameter_value(scenario, kOrigin[1]),
                 parameter_value(scenario, kOrigin[2])}),
        substeps(machine.substeps((1 + scenario.tick_jitter) / scenario.rate_Hz)),
        substep_s(1 / scenario.rate_Hz / substeps),
        arm(hand.start_m(), substep_s),
        panel(scenario, environment),
        random(static_cast<uint64_t>(scenario.seed) + kJitterStream) {
    if (scenario.hand.mass_kg > 0) palm.emplace(scenario.hand, hand.start_m());
  }

  Vec hand_N() const {
    if (is_away() || machine.is_torn_off()) return {};
    return hand.force_N(script_s, palm ? palm->position_m() : arm.position_m(),
                        palm ? palm->velocity_mps() : arm.velocity_mps(), machine.position_m(),
                        machine.velocity_mps());
  }
  bool is_away() const { return (last.state & record::kStateNotHomed) != 0; }
  // Target of the hand, which is away until a linkage is homed. Then it brings the tip to where the
  // script begins; meanwhile the script waits.
  Vec script_m(uint32_t before) {
    const double period_s = 1 / scenario.rate_Hz;
    if (is_away()) {
      arm = Arm(machine.position_m(), substep_s);
      if (palm) palm.emplace(scenario.hand, machine.position_m());
      reach_from = machine.joints();
      reach_left_s = kReach_s;
    }
    script_s = (before - waited) * period_s + jitter_s;
    if (!is_away() && !(reach_left_s > 0)) return hand.target_m(script_s);
    ++waited;
    if (!is_away()) reach_left_s -= period_s;
    return machine.on_way_to_start_m(reach_from, 1 - reach_left_s / kReach_s);
  }
  // By which the forces of a tick act later. It may take longer than a period: then its successor's
  // do not overtake them.
  double late_s(const record::TickRecord& now, uint32_t instructions) {
    if (!(scenario.controller_clock_Hz > 0)) return 0;
    if (now.input.command == 1u + params::kTickWork &&
        (now.output.state & record::kStateCommandTaken) != 0)
      tick_work = now.input.command_value;
    const double bound = static_cast<double>(params::kInstructionsAUnit * tick_work);
    return (instructions > 0 ? instructions : bound) / scenario.controller_clock_Hz;
  }
  // From the tick `before` to the next, `next_jitter_s` late.
  void move(uint32_t before, double next_jitter_s) {
    if (scenario.tick_jitter > 0) {
      substep_s = (1 / scenario.rate_Hz + next_jitter_s - jitter_s) / substeps;
      arm.set_step(substep_s);
    }
    const Vec script_m = this->script_m(before);
    jitter_s = next_jitter_s;
    for (uint32_t k = 0; k < substeps; ++k) {
      arm.advance(script_m);
      const Vec force_N = hand_N(), from_m = machine.position_m();
      machine.advance(force_N, substep_s);
      hand_J += dot(force_N, machine.position_m() - from_m);
      if (palm) palm->advance(arm.position_m(), arm.velocity_mps(), force_N, substep_s);
      script_s += substep_s;
    }
  }

  const Scenario& scenario;
  Tick controller;
  LockStepController* remote;
  Hand hand;
  Machine machine;
  uint32_t substeps;
  double substep_s;
  Arm arm;
  std::optional<Palm> palm;
  Operator panel;
  record::TickOutput last{};
  tools::Random random;
  double jitter_s = 0;  // by which the last tick was late
  float tick_work = params::kTable[params::kTickWork].initial;
  uint32_t last_work_us = 0;
  double hand_J = 0;
  uint32_t tick = 0;
  double script_s = 0;
  JointMotion reach_from;
  double reach_left_s = 0;
  uint32_t waited = 0;  // ticks
};

Simulation::Simulation(const Scenario& scenario, Tick controller, const Environment& environment,
                       LockStepController* remote)
    : loop_(std::make_unique<Loop>(scenario, std::move(controller), environment, remote)) {
  if (scenario.controller_clock_Hz > 0 && scenario.geometry_rate_Hz > 0 && remote == nullptr)
    throw Refused(scenario.file + ": `controller_clock` at two rates needs a controller that " +
                  "counts: --controller qemu:BOARD, or leave out `geometry_rate`");
  facts_.ticks = tick_count(scenario, loop_->hand);
  if (scenario.linkage && scenario.linkage->is_homed)
    facts_.spare_ticks = static_cast<uint32_t>(kMaxWait_s * scenario.rate_Hz);
  facts_.rate_Hz = scenario.rate_Hz;
  facts_.setup_ticks =
      static_cast<uint32_t>(std::min<size_t>(setup_ticks(scenario), facts_.ticks - 1));
  facts_.events = scenario.events;
  if (remote != nullptr) facts_.controller = remote->name(), facts_.compared = true;
}

Simulation::~Simulation() = default;

const EnergyBook* Simulation::energy() const { return loop_->machine.energy(); }

bool Simulation::next(RunTick& tick) {
  Loop& loop = *loop_;
  if (loop.tick == facts_.ticks || facts_.difference) return false;
  const double period_s = 1 / facts_.rate_Hz;
  double now_s = loop.tick * period_s;
  if (loop.tick > 0) {
    const uint32_t waited = loop.waited;
    const double jitter = loop.scenario.tick_jitter;
    loop.move(loop.tick - 1, jitter > 0 ? jitter * period_s * loop.random.uniform() : 0);
    now_s += loop.jitter_s;
    if (loop.waited > waited && facts_.spare_ticks > 0) ++facts_.ticks, --facts_.spare_ticks;
  }
  record::TickRecord& record = tick.record;
  record = {};
  record.input.tick = loop.tick++;
  record.input.clock_us = static_cast<uint32_t>(static_cast<uint64_t>(std::llround(now_s * 1e6)));
  loop.machine.fail_until(now_s);
  for (int axis = 0; axis < 3; ++axis) record.input.encoder_counts[axis] = loop.machine.count(axis);
  record.input.last_work_us = loop.last_work_us;
  loop.panel.fill(record.input, loop.last, now_s);
  record.input.flags |= model_flags(loop.scenario, record.input.tick) | loop.machine.flags();
  loop.controller(record.input, record.output);
  if (loop.remote != nullptr) {
    const record::TickRecord expected = record;
    const TickCost cost = loop.remote->tick(record.input, record.output);
    tick.instructions = cost.instructions;
    facts_.stack_high_bytes = std::max(facts_.stack_high_bytes, cost.stack_high_bytes);
    facts_.difference = first_difference(expected, record.output);
  }
  check_command(loop.scenario, record);
  tick.late_s = loop.late_s(record, tick.instructions);
  if (tick.instructions > 0)
    loop.last_work_us = static_cast<uint32_t>(std::lround(tick.late_s * 1e6));
  loop.machine.command(record.output.motor_N, tick.late_s);
  loop.last = record.output;
  tick.device_m = loop.machine.position_m();
  tick.target_m = loop.arm.position_m();
  tick.hand_N = loop.hand_N();
  tick.device_mps = loop.machine.velocity_mps();
  tick.joints = loop.machine.joints();
  tick.hand_J = loop.hand_J;
  facts_.hottest = loop.machine.hottest();
  tick.encoder_off_rad = loop.machine.encoder_off_rad();
  return true;
}

Trace run(const Scenario& scenario, ToolController& controller, const Environment& environment,
          LockStepController* remote, const std::function<void(double)>& progress) {
  Simulation simulation(scenario, tick_of(controller), environment, remote);
  Trace trace;
  for (RunTick tick; simulation.next(tick);) {
    trace.records.push_back(tick.record);
    if (progress) progress(static_cast<double>(trace.records.size()) / simulation.facts().ticks);
  }
  static_cast<RunFacts&>(trace) = simulation.facts();
  return trace;
}

}  // namespace firmtouch::host_sim
