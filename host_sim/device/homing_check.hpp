#pragma once
#include <cstdint>
#include <string>

#include "device/device_file.hpp"
#include "firmtouch/device/homing.hpp"

namespace firmtouch::host_sim {

/// What is wrong with the machine that is homed.
enum class HomingCase : uint32_t {
  kGood,
  kFinger,  // holds a joint somewhere, for all of the time or the first part of it
  kNoStop,  // of one joint
  kDead,    // one encoder stands, or reports invalid samples
  kReversed,
  kSwapped,  // two encoders
  kNoIndex,
  kNoise,  // pulses where there is no index
  kMotorDead,
  kMotorReversed,
};
constexpr uint32_t kHomingCases = 10;
const char* case_name(HomingCase it);

struct HomingRun {
  device::HomingFault fault = device::HomingFault::kTooLong;
  bool is_done = false;
  double seconds = 0;
  double torque_share = 0;  // the largest torque over the homing torque
  int64_t error_counts = 0;
};

/// The firmware's homing on a simulated linkage at 1 kHz, by index: start anywhere in the ranges,
/// stops of 50 to 5,000 N/m at the ends of the driven links, any index phase, raw counts anywhere,
/// every other run about the wrap. `seed` decides all. Encoder, index or motor fail from `from_s`
/// on, an encoder that reports invalid samples later.
HomingRun simulate_homing(const tools::LinkageDevice& device, HomingCase what, uint32_t seed,
                          double from_s = 0);

/// Of all runs of a case.
struct HomingTally {
  uint32_t runs = 0, homed = 0;
  uint32_t wrong = 0;  // more than a count off, longer than 2 s, or above the homing torque
  uint32_t faults[16] = {};
  int64_t worst_counts = 0;
  double slowest_s = 0, torque_share = 0;
};
void add(const HomingRun& run, HomingTally& to);
/// The faults by name: "12 blocked; 3 no index pulse".
std::string causes(const HomingTally& tally);

}  // namespace firmtouch::host_sim
