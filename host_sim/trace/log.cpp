#include "host_sim/trace/log.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>

#include "firmtouch/record/schema.hpp"
#include "firmtouch/servo/fault.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "log/file_sink.hpp"
#include "log/reader.hpp"
#include "log/writer.hpp"

namespace firmtouch::host_sim {
namespace {

using Slot = record::Numbered<record::TickRecord>;
constexpr uint32_t kBlockRecords = 512;

// Inputs that came with a later minor version of the log: older logs replay with 0.
const std::set<std::string> kAddedInputs = {"input.last_work_us"};

// Copies a word of the log's record to its offset in ours.
struct WordMove {
  uint32_t from, to;
};

// Throws Refused if an input is missing; adds missing outputs to `log.missing_outputs`.
std::vector<WordMove> moves(const std::string& path, const log::Header& header, Log& log) {
  const log::Header ours = tick_header();
  std::vector<WordMove> list;
  const std::vector<log::Column> theirs = header.columns();
  for (const log::Column& column : ours.columns()) {
    const auto found = std::find_if(theirs.begin(), theirs.end(), [&](const log::Column& c) {
      return c.name == column.name && c.field->type == column.field->type;
    });
    if (found != theirs.end()) {
      list.push_back({found->offset, column.offset});
    } else if (kAddedInputs.count(column.name) != 0) {
      continue;
    } else if (column.name.compare(0, 6, "input.") == 0) {
      throw Refused(path + ": its records have no field " + column.name +
                    ", which every tick needs; use the version that recorded it");
    } else {
      log.missing_outputs.insert(column.name);
    }
  }
  return list;
}

}  // namespace

log::Header tick_header() {
  log::Header header;
  for (const record::Field& field : record::kFields) {
    log::Field row;
    row.name = field.name;
    row.unit = field.unit;
    row.scale = log::decimal_of(field.scale);
    row.zero = log::decimal_of(field.zero);
    row.type = static_cast<log::Type>(field.type);
    row.count = field.count;
    header.fields.push_back(row);
  }
  header.record_bytes = log::place(header.fields);
  for (const record::Bit& bit : record::kBits)
    header.bits.push_back({bit.field, bit.bit, bit.what});
  for (uint32_t bit = 0; bit < servo::kFaultCount; ++bit)
    header.bits.push_back({"output.faults", bit, servo::fault_name(bit)});
  return header;
}

struct LogStream::File {
  std::string path, problem;
  std::unique_ptr<log::Sink> sink;
  std::optional<log::Writer> writer;
  std::vector<Slot> block;
  uint64_t number = 0;

  void check(bool is_done) const {
    if (!is_done) throw Refused(path + ": cannot be written: " + sink->problem());
  }
  void flush() {
    if (block.empty()) return;
    check(writer->append(reinterpret_cast<const uint8_t*>(block.data()),
                         static_cast<uint32_t>(block.size())));
    block.clear();
  }
};

LogStream::LogStream(const std::string& path, const std::map<std::string, std::string>& text,
                     uint32_t decimation, uint64_t first_number)
    : file_(std::make_unique<File>()) {
  log::Header header = tick_header();
  header.text = text;
  header.decimation = decimation;
  file_->path = path;
  file_->number = first_number;
  file_->sink = log::make_file(partial_of(path), file_->problem);
  if (file_->sink == nullptr) throw Refused(file_->problem);
  file_->writer.emplace(*file_->sink, header);
  file_->check(file_->writer->begin());
}

LogStream::~LogStream() {
  if (file_->sink != nullptr) remove_partial(file_->path);
}

void LogStream::add(const record::TickRecord& record) {
  file_->block.push_back({static_cast<uint32_t>(file_->number++), record});
  if (file_->block.size() == kBlockRecords) file_->flush();
}

void LogStream::finish() {
  file_->flush();
  file_->check(file_->writer->finish());
  file_->sink.reset();
  take_name(file_->path);
}

void write_log(const std::string& path, const Log& log) {
  LogStream stream(path, log.text, log.decimation, log.first_number);
  for (const record::TickRecord& record : log.records) stream.add(record);
  stream.finish();
}

Log read_log(const std::string& path) try {
  log::Reader reader(log::open_file(path), path);
  Log log;
  log.text = reader.header().text;
  log.decimation = reader.header().decimation;
  const std::vector<WordMove> list = moves(path, reader.header(), log);
  log::Block block;
  uint64_t next = 0;
  while (reader.next(block)) {
    uint64_t number = block.first_number;
    for (uint32_t i = 0; i < block.count; ++i) {
      const uint8_t* record = block.record(i);
      number += log::word(record, 0) - static_cast<uint32_t>(number);
      if (log.records.empty()) next = log.first_number = number;
      if (number != next && log.is_complete) {
        log.is_complete = false;
        log.damage = std::to_string((number - next) / log.decimation) +
                     " records are missing from number " + std::to_string(next) + " on";
      }
      next = number + log.decimation;
      if (!log.is_complete) continue;
      Slot slot{};
      for (const WordMove& move : list)
        std::memcpy(reinterpret_cast<uint8_t*>(&slot) + move.to, record + move.from, 4);
      log.records.push_back(slot.value);
    }
  }
  const std::string troubles = reader.troubles();
  if (!troubles.empty()) {
    log.is_complete = false;
    log.damage = troubles;
  }
  return log;
} catch (const log::Refused& refused) {
  throw Refused(refused.what());
} catch (const Refused&) {
  throw;
} catch (const std::runtime_error& error) {
  throw Refused(error.what());
}

}  // namespace firmtouch::host_sim
