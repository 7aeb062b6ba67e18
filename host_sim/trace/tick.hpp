#pragma once
#include <functional>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {

/// Computes a tick: a controller in this process, or a LockStepController.
using Tick = std::function<void(const record::TickInput&, record::TickOutput&)>;

/// Of a controller in this process, which must outlive the result.
template <class AnyController>
Tick tick_of(AnyController& controller) {
  return [&controller](const record::TickInput& input, record::TickOutput& output) {
    controller.tick(input, output);
    controller.make_model();
  };
}

}  // namespace firmtouch::host_sim
