#include "host_sim/log.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "firmtouch/core/crc32.hpp"
#include "host_sim/fields.hpp"
#include "host_sim/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr char kMagic[8] = {'F', 'T', 'L', 'O', 'G', '\r', '\n', '\x1a'};
constexpr uint32_t kHeaderBytes = 24;
constexpr uint32_t kTickTag = 0x4B434954u;  // 'TICK'
constexpr uint32_t kDoneTag = 0x454E4F44u;  // 'DONE'
constexpr uint32_t kBlockRecords = 1000;    // a second at 1 kHz: what a cut-off log loses at most
constexpr uint32_t kTagBytes = 12;

core::Bytes bytes_of(const char* data, size_t size) {
  return {reinterpret_cast<const uint8_t*>(data), static_cast<uint32_t>(size)};
}

void put(std::string& to, uint32_t word) {
  char bytes[4];
  std::memcpy(bytes, &word, 4);
  to.append(bytes, 4);
}

uint32_t get(const std::string& from, size_t at) {
  uint32_t word;
  std::memcpy(&word, from.data() + at, 4);
  return word;
}

std::string escaped(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
  return line;
}

std::string unescaped(const std::string& line) {
  std::string text;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 1 == line.size())
      text += line[i];
    else
      text += line[++i] == 'n' ? '\n' : line[i];
  }
  return text;
}

std::string schema() {
  constexpr const char* kKinds[] = {"u32", "i32", "f32"};
  std::string text;
  for (const Field& field : fields())
    text += "field " + std::string(kKinds[static_cast<int>(field.kind)]) + " " + field.name + "\n";
  return text;
}

std::string crc_text(uint32_t crc) {
  char text[16];
  std::snprintf(text, sizeof text, "%08x", crc);
  return text;
}

struct LogReader {
  const std::string& path;
  const std::string& bytes;
  size_t at = 0;

  [[noreturn]] void refuse(const std::string& what) const {
    throw Refused(path + ": byte " + std::to_string(at) + ": " + what);
  }
  void header(Log& log);
  bool block(Log& log);
};

void LogReader::header(Log& log) {
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    refuse("this is no log; `firmtouch-sim run SCENARIO --log FILE` makes one");
  const uint32_t version = get(bytes, 8), text_bytes = get(bytes, 16);
  if (version != kLogVersion)
    refuse("version " + std::to_string(version) +
           " of the log format; this program reads version " + std::to_string(kLogVersion));
  if (text_bytes > bytes.size() - kHeaderBytes)
    refuse("cut off inside its header; record the run again");
  const uint32_t crc = core::crc32(bytes_of(bytes.data() + kHeaderBytes, text_bytes),
                                   core::crc32(bytes_of(bytes.data(), 20)));
  if (crc != get(bytes, 20))
    refuse("damaged header: its CRC is " + crc_text(crc) + ", stated " + crc_text(get(bytes, 20)));
  std::istringstream lines(bytes.substr(kHeaderBytes, text_bytes));
  std::string line, found_schema;
  while (std::getline(lines, line)) {
    const size_t blank = line.find(' ');
    const std::string key = line.substr(0, blank);
    if (key == "field")
      found_schema += line + "\n";
    else if (blank != std::string::npos)
      log.text[key] = unescaped(line.substr(blank + 1));
  }
  if (found_schema != schema() || get(bytes, 12) != sizeof(record::TickRecord))
    refuse("its records have other fields than this program's; use the version that recorded it");
  at = kHeaderBytes + text_bytes;
}

// Result: false at the end of the log.
bool LogReader::block(Log& log) {
  if (bytes.size() - at < kTagBytes) return log.is_whole = false;
  const uint32_t tag = get(bytes, at), count = get(bytes, at + 4), stated = get(bytes, at + 8);
  const uint32_t head = core::crc32(bytes_of(bytes.data() + at, 8));
  if (tag == kDoneTag) {
    if (head != stated || count != log.records.size())
      refuse("damaged end: it tells of " + std::to_string(count) + " records, " +
             std::to_string(log.records.size()) + " are here");
    if (bytes.size() - at != kTagBytes) refuse("bytes follow the end of the log");
    return false;
  }
  if (tag != kTickTag) refuse("neither a block of ticks nor the end; the log is damaged here");
  const size_t size = size_t{count} * sizeof(record::TickRecord);
  if (bytes.size() - at - kTagBytes < size) return log.is_whole = false;
  const uint32_t crc = core::crc32(bytes_of(bytes.data() + at + kTagBytes, size), head);
  if (crc != stated)
    refuse("damaged block of " + std::to_string(count) + " ticks: its CRC is " + crc_text(crc) +
           ", stated " + crc_text(stated));
  const size_t before = log.records.size();
  log.records.resize(before + count);
  if (count > 0) std::memcpy(&log.records[before], bytes.data() + at + kTagBytes, size);
  at += kTagBytes + size;
  return true;
}

}  // namespace

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (!in || std::filesystem::is_directory(path) || !(bytes << in.rdbuf()))
    if (!in || in.peek() != std::ifstream::traits_type::eof())
      throw Refused(path + ": cannot be read: " + std::strerror(errno));
  return bytes.str();
}

std::string partial_of(const std::string& path) { return path + ".partial"; }

void check_writable(const std::string& path) {
  const std::string partial = partial_of(path);
  const bool is_folder = std::filesystem::is_directory(path);
  std::ofstream out;
  if (!is_folder) out.open(partial, std::ios::binary);
  if (!is_folder && out) {
    out.close();
    std::remove(partial.c_str());
    return;
  }
  throw Refused(path + ": cannot be written: " + std::strerror(is_folder ? EISDIR : errno));
}

void write_file(const std::string& path, const std::string& bytes) {
  const std::string partial = partial_of(path);
  std::ofstream out(partial, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out && std::rename(partial.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  std::remove(partial.c_str());
  throw Refused(path + ": cannot be written: " + std::strerror(error));
}

void write_log(const std::string& path, const Log& log) {
  std::string text = schema();
  for (const auto& [key, value] : log.text) text += key + " " + escaped(value) + "\n";
  std::string bytes(kMagic, sizeof kMagic);
  put(bytes, kLogVersion);
  put(bytes, sizeof(record::TickRecord));
  put(bytes, static_cast<uint32_t>(text.size()));
  put(bytes,
      core::crc32(bytes_of(text.data(), text.size()), core::crc32(bytes_of(bytes.data(), 20))));
  bytes += text;
  for (size_t first = 0; first < log.records.size(); first += kBlockRecords) {
    const size_t count = std::min<size_t>(kBlockRecords, log.records.size() - first);
    const size_t at = bytes.size();
    const char* records = reinterpret_cast<const char*>(&log.records[first]);
    put(bytes, kTickTag);
    put(bytes, static_cast<uint32_t>(count));
    put(bytes, core::crc32(bytes_of(records, count * sizeof(record::TickRecord)),
                           core::crc32(bytes_of(bytes.data() + at, 8))));
    bytes.append(records, count * sizeof(record::TickRecord));
  }
  const size_t at = bytes.size();
  put(bytes, kDoneTag);
  put(bytes, static_cast<uint32_t>(log.records.size()));
  put(bytes, core::crc32(bytes_of(bytes.data() + at, 8)));
  write_file(path, bytes);
}

Log read_log(const std::string& path) {
  const std::string bytes = read_file(path);
  Log log;
  LogReader reader{path, bytes};
  reader.header(log);
  while (reader.block(log)) {
  }
  return log;
}

}  // namespace firmtouch::host_sim
