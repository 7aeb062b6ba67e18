#pragma once
#include <cstdint>
#include <string>
#include <vector>

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

/// A part of a sweep: every `of`th run, from the `number`th on. "2/8".
struct Shard {
  uint64_t number = 1, of = 1;
  uint64_t runs(uint64_t of_all) const { return (of_all + of - number) / of; }
  uint64_t run(uint64_t nth) const { return nth * of + number - 1; }
};
/// Throws Refused.
Shard shard_of(const std::string& text);

/// How many combinations there are. Throws Refused above 10 million.
uint64_t combinations(const std::vector<Varied>& varied);
/// Which of its values each takes in a run: the last one changes from run to run.
std::vector<std::string> values_of(const std::vector<Varied>& varied, uint64_t run);

}  // namespace firmtouch::host_sim
