#pragma once
#include <functional>
#include <optional>

#include "firmtouch/controller.hpp"
#include "host_sim/trace/fields.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

/// Computes a tick: a controller of this process, or one at the far end of a Port.
using Tick = std::function<void(const record::TickInput&, record::TickOutput&)>;

/// Feeds a log's inputs to `tick` (of a controller that is ready and fresh) and compares every bit
/// of its outputs with the recorded ones, but for those that the log does not have. Result: the
/// first difference; nothing where all ticks agree. "expected" is what the log holds.
std::optional<Difference> replay(const Log& log, const Tick& tick,
                                 const std::function<void(double)>& progress = {});
std::optional<Difference> replay(const Log& log, Controller& controller);

}  // namespace firmtouch::host_sim
