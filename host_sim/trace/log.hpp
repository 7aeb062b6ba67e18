#pragma once
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
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

/// Writes a log while a run goes on. Memory: one block, and 24 B of index for each block of 512
/// records. Throws Refused if the file cannot be written; leaves no partial file.
class LogStream {
 public:
  LogStream(const std::string& path, const std::map<std::string, std::string>& text,
            uint32_t decimation = 1, uint64_t first_number = 0);
  ~LogStream();
  void add(const record::TickRecord& record);
  void finish();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

void write_log(const std::string& path, const Log& log);

/// Reads the records before the first gap. Throws Refused with path and reason: not a log, another
/// version, or a log without an input that this program needs.
Log read_log(const std::string& path);

/// Read and write a whole file. Both throw Refused with the path.
std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);
/// Throws Refused if write_file() would fail for a reason that is visible now. Changes nothing.
/// Pre: cli::check_output() takes it.
void check_writable(const std::string& path);
/// Path that is written to before the file gets its name; that of a device or a pipe is its own.
std::string partial_of(const std::string& path);
/// Removes what was written there, except a device or a pipe.
void remove_partial(const std::string& path);
/// Renames the written partial file to `path`. Throws Refused, and removes it, if that fails.
void take_name(const std::string& path);

/// Text written as it comes: to a file that gets its name at the end, or to stdout for the path
/// "-".
class TextStream {
 public:
  explicit TextStream(const std::string& path);
  ~TextStream();
  TextStream(const TextStream&) = delete;
  TextStream& operator=(const TextStream&) = delete;
  void add(const std::string& text);
  void finish();

 private:
  std::string path_;
  std::FILE* file_;
};

}  // namespace firmtouch::host_sim
