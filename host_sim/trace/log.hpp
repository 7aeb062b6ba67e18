#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "firmtouch/record/tick.hpp"
#include "log/schema.hpp"

namespace firmtouch::host_sim {

/// A recorded run (tools/FORMAT.md), converted to this program's record.
struct Log {
  std::map<std::string, std::string> text;  // of the header, without the schema
  std::vector<record::TickRecord> records;
  // Replay needs records numbered from 0 without gaps.
  uint64_t first_number = 0;
  uint32_t decimation = 1;
  bool is_complete = true;  // false: cut off, damaged or incomplete after the records given
  std::string damage;       // in words
  std::set<std::string> missing_outputs;  // outputs of this program that the log does not have
};

/// Log header that describes a TickRecord: record::kFields and the names of all bits.
log::Header tick_header();

/// Throws Refused if the file cannot be written; leaves no partial file.
void write_log(const std::string& path, const Log& log);

/// Reads the records before the first gap. Throws Refused with path and reason: not a log, another
/// version, or a log without an input that this program needs.
Log read_log(const std::string& path);

/// Read and write a whole file. Both throw Refused with the path.
std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);
/// Throws Refused if write_file() would fail for a reason that is visible now. Changes nothing.
void check_writable(const std::string& path);
/// Path that write_file() writes to before it renames the file.
std::string partial_of(const std::string& path);

}  // namespace firmtouch::host_sim
