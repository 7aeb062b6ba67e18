#pragma once
#include <string>

#include "host_sim/trace/log.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// Every tick as a row, written as the run goes on: all fields of its record under their names,
/// then what only the simulator has (the device's true position, the hand's target and force,
/// instructions), then the names of the set bits. Numbers print as %.9g.
class CsvStream {
 public:
  /// Throws Refused if `path` cannot be written; "-" is stdout.
  explicit CsvStream(const std::string& path);
  void add(const RunTick& tick, double time_s);
  void finish() { out_.finish(); }

 private:
  TextStream out_;
  log::Header header_ = tick_header();
  std::string row_;
};

}  // namespace firmtouch::host_sim
