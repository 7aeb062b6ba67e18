#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/moving_points.hpp"
#include "firmtouch/controller/tool_controller.hpp"
#include "host_sim/controllers/lock_step_controller.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/plant/machine.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/fields.hpp"
#include "host_sim/trace/tick.hpp"

namespace firmtouch::host_sim {

/// One tick of a run: its record, and what only the simulator has.
struct RunTick {
  record::TickRecord record{};
  Vec device_m;                // true position, before encoder quantization
  Vec target_m;                // target of the hand
  Vec hand_N;                  // force of the hand
  Vec device_mps;              // true velocity
  tools::JointMotion joints;   // the true ones of a linkage
  double hand_J = 0;           // work of the hand on the device so far
  double encoder_off_rad = 0;  // the most by which an encoder has miscounted
  uint32_t instructions = 0;   // 0: the controller does not count them
  double late_s = 0;           // by which its forces act later, for `controller_clock`
};

/// A run apart from its ticks.
struct RunFacts {
  uint32_t ticks = 0;        // planned; a difference ends the run before
  uint32_t spare_ticks = 0;  // by which homing and reaching may yet lengthen it
  double rate_Hz = 1000;
  uint32_t setup_ticks = 0;  // at the begin: they set the parameters of the scenario
  std::string controller = "in-process";
  bool compared = false;  // a remote controller is compared with the in-process one
  std::vector<Event> events;
  std::optional<Difference> difference;  // the first one; it ends the run
  uint32_t stack_high_bytes = 0;
  Machine::Heat hottest;  // winding so far
};

/// Whether the motors are on in this tick: enabled, and no fault latched. Contact, depth and guide
/// figures of a report count these ticks only.
bool motors_are_on(const record::TickOutput& output);

/// The controller's parameter table, with short names that omit the unit's suffix.
std::vector<ParameterRow> parameter_rows();

/// The same as text for --help, one line per parameter.
std::string parameter_help();

/// Derives settings that the scenario does not state: tick period, model age, encoder counts per
/// metre.
void complete(Scenario& scenario);
/// A parameter's value after the scenario's settings.
double parameter_value(const Scenario& scenario, uint32_t parameter);
Vec scene_origin_m(const Scenario& scenario);

/// A run of `scenario` by `controller`, tick by tick; its memory does not grow with its duration.
/// If `remote` is given, it drives the device, and every bit of its outputs is compared with the
/// in-process controller's. Pre: `controller` is ready and has run no tick; all references outlive
/// this. Result: deterministic; the same scenario and controller give the same records.
class Simulation {
 public:
  /// Throws Refused if the script needs a guide that the asset lacks, or the run is too long.
  Simulation(const Scenario& scenario, Tick controller, const Environment& environment,
             LockStepController* remote = nullptr);
  ~Simulation();
  const RunFacts& facts() const { return facts_; }
  /// Of the simulated linkage so far; null for a Cartesian device.
  const EnergyBook* energy() const;
  /// Runs one tick. Result: false if the run has ended. Throws Refused if the controller rejects a
  /// parameter.
  bool next(RunTick& tick);

 private:
  struct Loop;
  RunFacts facts_;
  std::unique_ptr<Loop> loop_;
};

/// A run with all its records in memory, for tests.
struct Trace : RunFacts {
  std::vector<record::TickRecord> records;
};
Trace run(const Scenario& scenario, ToolController& controller, const Environment& environment,
          LockStepController* remote = nullptr, const std::function<void(double)>& progress = {});

}  // namespace firmtouch::host_sim
