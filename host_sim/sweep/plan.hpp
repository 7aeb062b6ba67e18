#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "batch/shard.hpp"
#include "device/refused.hpp"

namespace firmtouch::host_sim {

using tools::Refused;

/// A line of a scenario, and the values that it takes in turn, with their unit.
struct Varied {
  std::string key;
  std::vector<std::string> values;
};

/// "mass=60 g,75 g" or "hand_stiffness=100..1000:10 N/m" (10 values, evenly, both ends included).
/// Throws Refused with the text and what it should be.
Varied varied_of(const std::string& text);

/// How many combinations there are. Throws Refused above 10 million.
uint64_t combinations(const std::vector<Varied>& varied);
/// Which of its values each takes in a run: the last one changes from run to run.
std::vector<std::string> values_of(const std::vector<Varied>& varied, uint64_t run);

}  // namespace firmtouch::host_sim
