#pragma once
#include <functional>
#include <optional>

#include "host_sim/trace/fields.hpp"
#include "host_sim/trace/log.hpp"
#include "host_sim/trace/tick.hpp"

namespace firmtouch::host_sim {

/// Feeds a log's inputs to `tick` and compares every bit of its outputs with the recorded ones.
/// Outputs that the log does not have are skipped.
/// Pre: the controller is ready and has run no tick.
/// Result: the first difference, with the recorded value as `expected`; nullopt if there is none.
std::optional<Difference> replay(const Log& log, const Tick& tick,
                                 const std::function<void(double)>& progress = {});

}  // namespace firmtouch::host_sim
