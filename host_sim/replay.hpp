#pragma once
#include <optional>

#include "firmtouch/controller.hpp"
#include "host_sim/fields.hpp"
#include "host_sim/log.hpp"

namespace firmtouch::host_sim {

/// Feeds a log's inputs to `controller` (ready, fresh) and compares every bit of its outputs with
/// the recorded ones. Result: the first difference; nothing where all ticks agree. "expected" is
/// what the log holds.
std::optional<Difference> replay(const Log& log, Controller& controller);

}  // namespace firmtouch::host_sim
