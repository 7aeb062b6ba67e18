#pragma once
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace firmtouch::bench {

struct Options {
  std::vector<std::string> models;  // files; none: the demo part (bench/models.hpp)
  std::string peer;                 // a command, run by the shell; empty: none
  std::string figures;              // a folder for drawings; empty: none
  bool is_long = false;             // the full sizes
  // Of `touch`:
  uint64_t ticks = 0;       // a model; 0: as is_long says
  uint64_t seed = 0;        // of the first ride
  bool is_release = false;  // only hands that leave, in full
};

/// A bench prints figures of the papers' tables or the project's bars. It throws a Problem where it
/// cannot run.
struct Bench {
  const char* name;
  const char* summary;  // one line
  void (*run)(const Options& options, Report& report);
};

/// Every bench there is, in the order of the list in benches.cpp.
std::vector<Bench> benches();

}  // namespace firmtouch::bench
