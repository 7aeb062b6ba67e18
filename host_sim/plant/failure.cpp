#include "host_sim/plant/failure.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr const char* kNames[kFailureModes] = {
    "encoder_stuck", "encoder_lost",   "encoders_swapped", "encoder_reversed", "encoder_slipped",
    "motor_dead",    "motor_reversed", "motor_hot",        "link_broken",      "index_absent"};

}  // namespace

const char* failure_name(FailureMode mode) { return kNames[static_cast<uint32_t>(mode)]; }

std::string failure_names() {
  std::string names;
  for (const char* const name : kNames) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

bool find_failure(const std::string& name, FailureMode& mode) {
  for (uint32_t i = 0; i < kFailureModes; ++i) {
    if (name != kNames[i]) continue;
    mode = static_cast<FailureMode>(i);
    return true;
  }
  return false;
}

}  // namespace firmtouch::host_sim
