#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmtouch/controller/full_controller.hpp"
#include "host_sim/controllers/lock_step_controller.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/fields.hpp"

namespace firmtouch::host_sim {

/// Result of a run: the tick records, and the plant's state at each tick.
struct Trace {
  std::vector<record::TickRecord> records;
  std::vector<Vec> device_m;           // true position, before encoder quantization
  std::vector<Vec> target_m;           // target of the hand
  std::vector<Vec> hand_N;             // force of the hand
  std::vector<uint32_t> instructions;  // per tick; empty if the controller does not count them
  uint32_t stack_high_bytes = 0;
  std::string controller = "in-process";
  bool compared = false;                 // a remote controller was compared with the in-process one
  std::optional<Difference> difference;  // the first one; it ends the run
  std::vector<Event> events;
  double rate_Hz = 1000;
  size_t setup_ticks = 0;  // ticks at the begin that set the scenario's parameters
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

/// Runs `scenario` on `controller`. If `remote` is given, it drives the device, and every bit of
/// its outputs is compared with the in-process controller's. Pre: `controller` is ready and has run
/// no tick. Result: deterministic; the same scenario and controller give the same records.
Trace run(const Scenario& scenario, FullController& controller, const Environment& environment,
          LockStepController* remote, const std::function<void(double)>& progress);

}  // namespace firmtouch::host_sim
