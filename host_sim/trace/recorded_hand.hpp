#pragma once
#include <string>
#include <vector>

#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {

/// The tool's way and the force on it in a recorded run, from where its device is homed; the time
/// of its clock. Throws Refused with the log's path: it is damaged, has no position or force, or
/// these are not finite; the clock stands or jumps by more than a second.
std::vector<HandSample> recorded_hand(const std::string& path);

}  // namespace firmtouch::host_sim
