#include "host_sim/replay.hpp"

namespace firmtouch::host_sim {

std::optional<Difference> replay(const Log& log, Controller& controller) {
  for (const record::TickRecord& recorded : log.records) {
    record::TickOutput output{};
    controller.tick(recorded.input, output);
    if (std::optional<Difference> difference = first_difference(recorded, output))
      return difference;
  }
  return {};
}

}  // namespace firmtouch::host_sim
