#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmtouch/controller.hpp"
#include "host_sim/controllers/port.hpp"
#include "host_sim/plant/environment.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/fields.hpp"

namespace firmtouch::host_sim {

/// What a run leaves: the records, as a log holds them, and what only the simulator knows.
struct Trace {
  std::vector<record::TickRecord> records;
  std::vector<Vec> device_m;  // true position at each tick, not the encoder's
  std::vector<Vec> target_m;  // of the hand
  std::vector<Vec> hand_N;
  std::vector<uint32_t> instructions;  // a tick, where the controller counts them; else empty
  uint32_t stack_high_bytes = 0;
  std::string controller = "in-process";
  bool compared = false;  // a remote controller's outputs were compared with the in-process one's
  std::optional<Difference> difference;  // the first one; the run ends there
  std::vector<Event> events;
  double rate_Hz = 1000;
  size_t setup_ticks = 0;  // the first ones, in which the scenario's parameters were set
};

/// Whether a hand feels the motors in this tick: enabled, and no fault yet. What a report tells of
/// contact, depth and guide is of these ticks.
bool motors_are_on(const record::TickOutput& output);

/// The parameter table as the scenario reader needs it: names without their unit's suffix too.
std::vector<ParameterRow> parameter_rows();

/// The same as text, a line a parameter, for --help.
std::string parameter_help();

/// Completes a scenario with what follows from it: tick period, encoder counts a metre.
void complete(Scenario& scenario);
/// A parameter's value after the scenario's settings.
double parameter_value(const Scenario& scenario, uint32_t parameter);
Vec scene_origin_m(const Scenario& scenario);

/// Runs `scenario` on `controller` (ready, fresh) and, where `remote` is given, on that too: the
/// remote one drives the device, and every bit of its outputs is compared with the in-process
/// one's. Deterministic: the same scenario and controller give the same records.
Trace run(const Scenario& scenario, Controller& controller, const World& world, Port* remote,
          const std::function<void(double)>& progress);

}  // namespace firmtouch::host_sim
