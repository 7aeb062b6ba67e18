#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {

// A recorded run, `.ftl` version 1, little-endian:
//
//   header  "FTLOG\r\n\x1a", u32 version, u32 bytes of a record, u32 bytes of the text,
//           u32 CRC-32 of the 20 bytes before and the text
//   text    "key value" lines: asset, asset_crc, parameter_table, scenario, ...; each line that
//           begins with `field` is the schema of one word of a record
//   blocks  u32 'TICK', u32 records, u32 CRC-32 of the 8 bytes before and the records; the records
//   end     u32 'DONE', u32 records in all, u32 CRC-32 of the 8 bytes before
//
// A log without its end was cut off; its whole blocks can still be read.

constexpr uint32_t kLogVersion = 1;

struct Log {
  std::map<std::string, std::string> text;  // of the header, without the schema
  std::vector<record::TickRecord> records;
  bool is_whole = true;  // false: cut off after the records given
};

/// Throws Refused where the file cannot be written; no partial file is left.
void write_log(const std::string& path, const Log& log);

/// Throws Refused naming file, byte and what is wrong: not a log, another version or schema, a
/// block whose CRC differs.
Log read_log(const std::string& path);

/// Whole file in and out. Throw Refused naming the file.
std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);
/// Whether write_file() could, as far as can be told beforehand; changes nothing.
void check_writable(const std::string& path);
/// Where write_file() writes before it gives the file its name.
std::string partial_of(const std::string& path);

}  // namespace firmtouch::host_sim
