#include "host_sim/trace/recorded_hand.hpp"

#include <cmath>

#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kMaxStep_us = 1000000;

}  // namespace

std::vector<HandSample> recorded_hand(const std::string& path) {
  const Log log = read_log(path);
  if (!log.is_complete)
    throw Refused(path + ": " + log.damage + "; `firmtouch log cut` keeps what is whole");
  for (const std::string& name : log.missing_outputs)
    if (name.find("position_m") != std::string::npos || name.find("force_N") != std::string::npos)
      throw Refused(path + ": it has no " + name + ", which a hand needs");
  std::vector<HandSample> samples;
  double time_s = 0;
  uint32_t before_us = 0;
  for (const record::TickRecord& record : log.records) {
    if ((record.output.state & record::kStateNotHomed) != 0) continue;
    const std::string place = path + ": at tick " + std::to_string(record.input.tick);
    if (!samples.empty()) {
      const uint32_t step_us = record.input.clock_us - before_us;
      if (step_us == 0 || step_us > kMaxStep_us)
        throw Refused(place + " its clock stands or jumps; `firmtouch log cut` parts it there");
      time_s += step_us * 1e-6;
    }
    before_us = record.input.clock_us;
    const HandSample sample{time_s, wide(record.output.position_m), wide(record.output.force_N)};
    if (!std::isfinite(norm(sample.at_m)) || !std::isfinite(norm(sample.force_N)))
      throw Refused(place + " position or force is not finite");
    samples.push_back(sample);
  }
  if (samples.size() < 2)
    throw Refused(path + ": it has no two ticks in which its device is homed");
  return samples;
}

}  // namespace firmtouch::host_sim
