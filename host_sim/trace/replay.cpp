#include "host_sim/trace/replay.hpp"

namespace firmtouch::host_sim {

std::optional<Difference> replay(const Log& log, const Tick& tick,
                                 const std::function<void(double)>& progress) {
  const size_t ticks = log.records.size();
  for (size_t i = 0; i < ticks; ++i) {
    const record::TickRecord& recorded = log.records[i];
    record::TickOutput output{};
    tick(recorded.input, output);
    if (std::optional<Difference> difference =
            first_difference(recorded, output, log.missing_outputs))
      return difference;
    if (progress && i % 1024 == 0) progress(static_cast<double>(i) / static_cast<double>(ticks));
  }
  if (progress) progress(1);
  return {};
}

}  // namespace firmtouch::host_sim
