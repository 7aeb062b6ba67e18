#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

/// A field of the records in two runs; ticks are matched by their number.
struct FieldComparison {
  std::string name;
  double worst = 0, rms = 0;  // difference; NaN on one side counts as infinite
  uint32_t worst_tick = 0;
  uint32_t first_tick = 0;  // of the first difference in any bit
};

/// What a run comes to.
struct RunFigures {
  uint64_t ticks = 0, contact_ticks = 0;
  uint64_t exact_ticks = 0;
  double peak_force_N = 0, rms_force_N = 0, peak_motor = 0;
  double peak_speed_mps = 0, deepest_m = 0, mean_visits = 0;
  uint32_t worst_visits = 0, faults = 0;
};

struct Comparison {
  uint64_t ticks = 0;                   // that both have
  std::vector<FieldComparison> fields;  // that differ, in the order of the record
  std::vector<std::string> settings;    // entries of the header that differ: "key: a | b"
  RunFigures first, second;
};

Comparison compare(const Log& first, const Log& second);

}  // namespace firmtouch::host_sim
