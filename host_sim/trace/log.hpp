#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "firmtouch/record/tick.hpp"
#include "log/schema.hpp"

namespace firmtouch::host_sim {

/// A recorded run (tools/FORMAT.md) as the simulator needs it: its ticks, in this program's own
/// fields.
struct Log {
  std::map<std::string, std::string> text;  // of the header, without the schema
  std::vector<record::TickRecord> records;
  // Numbers of a run begin at 0 and leave none out; replay needs that.
  uint64_t first_number = 0;
  uint32_t decimation = 1;
  bool is_whole = true;           // false: cut off, damaged or incomplete after the records given
  std::string why_not_whole;      // in words
  std::set<std::string> without;  // outputs of this program that the log does not have
};

/// What a record is, from record::kFields, with the names of all bits.
log::Header tick_header();

/// Throws Refused where the file cannot be written; no partial file is left.
void write_log(const std::string& path, const Log& log);

/// The records up to the first that is missing. Throws Refused naming the file and what is wrong:
/// not a log, another version, an input that this program needs and the log does not have.
Log read_log(const std::string& path);

/// Whole file in and out. Throw Refused naming the file.
std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);
/// Whether write_file() could, as far as can be told beforehand; changes nothing.
void check_writable(const std::string& path);
/// Where write_file() writes before it gives the file its name.
std::string partial_of(const std::string& path);

}  // namespace firmtouch::host_sim
