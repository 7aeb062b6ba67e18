#pragma once
#include <functional>
#include <optional>

#include "firmtouch/controller/full_controller.hpp"
#include "host_sim/trace/fields.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

/// Computes a tick: the in-process controller, or a LockStepController.
using Tick = std::function<void(const record::TickInput&, record::TickOutput&)>;

/// Feeds a log's inputs to `tick` and compares every bit of its outputs with the recorded ones.
/// Outputs that the log does not have are skipped.
/// Pre: the controller is ready and has run no tick.
/// Result: the first difference, with the recorded value as `expected`; nullopt if there is none.
std::optional<Difference> replay(const Log& log, const Tick& tick,
                                 const std::function<void(double)>& progress = {});
std::optional<Difference> replay(const Log& log, FullController& controller);

}  // namespace firmtouch::host_sim
