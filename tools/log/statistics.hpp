#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "log/reader.hpp"

namespace firmtouch::log {

/// Summary of a run from its log. Parts whose fields the log does not have are empty.
struct Statistics {
  uint64_t records = 0, missing = 0, blocks = 0;
  uint64_t first_number = 0, last_number = 0;
  double seconds = 0;  // from the first record's clock to the last one's
  std::vector<Gap> gaps;
  std::string troubles;

  // Between ticks whose records follow each other; one of a decimated log is the mean of its ticks.
  struct Period {
    uint64_t count = 0;
    double median_us = 0, mean_us = 0, deviation_us = 0;
    double min_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
    uint64_t max_number = 0;  // of the record that came latest
  } period;

  struct Steps {
    uint64_t number = 0;
    uint32_t steps = 0;
  };
  double mean_steps = 0;
  std::vector<Steps> worst_steps;  // the five worst, the worst first; the earlier of equals

  struct Fault {
    std::string what;
    uint64_t first_number = 0;
    uint64_t records = 0;  // that show it
  };
  std::vector<Fault> faults;  // in the order of their bits
  // Records that hold an infinity or NaN, and the first of them.
  struct NotFinite {
    uint64_t records = 0;
    uint64_t first_number = 0;
    std::string first_field;
  } not_finite;
  double max_force_N = 0;
  uint64_t max_force_number = 0;
};

/// Reads the log through.
Statistics statistics_of(Reader& reader);

std::string text_of(const Statistics& statistics);

}  // namespace firmtouch::log
