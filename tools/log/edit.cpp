#include "log/edit.hpp"

#include <cstdio>
#include <stdexcept>

#include "log/file_sink.hpp"
#include "log/reader.hpp"
#include "log/writer.hpp"

namespace firmtouch::log {
namespace {

// A log that takes its name when it is whole.
class Output {
 public:
  Output(const std::string& path, const Header& header) : path_(path), partial_(path + ".partial") {
    if (is_special(path))
      throw std::runtime_error(path + ": a device or a pipe holds no log: name a file");
    std::string problem;
    sink_ = make_file(partial_, problem);
    if (!sink_) throw std::runtime_error(problem);
    writer_ = std::make_unique<Writer>(*sink_, header);
    if (!writer_->begin()) fail();
  }
  ~Output() {
    if (sink_) std::remove(partial_.c_str());
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void append(const uint8_t* records, uint32_t count) {
    if (count > 0 && !writer_->append(records, count)) fail();
  }
  void close() {
    if (!writer_->finish()) fail();
    records_ = writer_->records();
    writer_.reset();
    sink_.reset();
    if (std::rename(partial_.c_str(), path_.c_str()) == 0) return;
    std::remove(partial_.c_str());
    throw std::runtime_error(path_ + ": cannot be written");
  }
  uint64_t records() const { return writer_ ? writer_->records() : records_; }

 private:
  [[noreturn]] void fail() { throw std::runtime_error(sink_->problem()); }
  std::string path_, partial_;
  std::unique_ptr<Sink> sink_;
  std::unique_ptr<Writer> writer_;
  uint64_t records_ = 0;
};

// Calls take(number, record) for each record of the log until it says false.
template <class Take>
void each_record(Reader& reader, Take take) {
  Block block;
  while (reader.next(block)) {
    uint64_t number = block.first_number;
    for (uint32_t i = 0; i < block.count; ++i) {
      number += word(block.record(i), 0) - static_cast<uint32_t>(number);
      if (!take(number, block, i)) return;
    }
  }
}

void check_same_run(const std::string& path, const Header& first, const Header& next) {
  if (first.columns().size() != next.columns().size() || first.record_bytes != next.record_bytes ||
      first.decimation != next.decimation)
    throw std::runtime_error(path + ": its records are of another kind than those before it");
  for (size_t i = 0; i < first.fields.size(); ++i)
    if (first.fields[i].name != next.fields[i].name || first.fields[i].type != next.fields[i].type)
      throw std::runtime_error(path + ": its records have " + next.fields[i].name +
                               " where those before it have " + first.fields[i].name);
  for (const char* key :
       {"asset_crc", "build", "parameter_table", "controller", "recorded_at_us"}) {
    const auto a = first.text.find(key), b = next.text.find(key);
    const std::string one = a == first.text.end() ? "" : a->second;
    const std::string two = b == next.text.end() ? "" : b->second;
    if (one != two)
      throw std::runtime_error(path + ": it is of another run: its " + key + " is " + two +
                               ", that of the one before it " + one);
  }
}

}  // namespace

uint64_t cut(const std::string& path, uint64_t from, uint64_t to, const std::string& output,
             std::string* troubles) {
  Reader reader(open_file(path), path);
  Header header = reader.header();
  header.text["cut"] = std::to_string(from) + " to " + std::to_string(to);
  Output out(output, header);
  Block block;
  while (reader.next(block)) {
    uint32_t begin = 0, end = 0;
    uint64_t number = block.first_number;
    for (uint32_t i = 0; i < block.count; ++i) {
      number += word(block.record(i), 0) - static_cast<uint32_t>(number);
      if (number < from) begin = i + 1;
      if (number < to) end = i + 1;
    }
    if (begin < end) out.append(block.record(begin), end - begin);
  }
  if (troubles != nullptr) *troubles = reader.troubles();
  if (out.records() == 0)
    throw std::runtime_error(path + ": no record has a number from " + std::to_string(from) +
                             " to below " + std::to_string(to));
  out.close();
  return out.records();
}

uint64_t number_at(const std::string& path, double seconds) {
  Reader reader(open_file(path), path);
  const Field* clock = reader.header().find("input.clock_us");
  if (clock == nullptr)
    throw std::runtime_error(path + ": its records have no input.clock_us: give record numbers");
  uint64_t found = 0;
  uint64_t passed = 0;  // whole numbers: a sum of decimals would miss a tick
  uint32_t last = 0;
  bool is_first = true;
  each_record(reader, [&](uint64_t number, const Block& block, uint32_t i) {
    const uint32_t now = word(block.record(i), clock->offset);
    if (!is_first) passed += now - last;
    is_first = false;
    last = now;
    const bool is_before = static_cast<double>(passed) + 0.5 < seconds / clock->scale;
    found = number + (is_before ? 1 : 0);
    return is_before;
  });
  return found;
}

uint64_t join(const std::vector<std::string>& paths, const std::string& output,
              std::string* troubles) {
  const Reader first(open_file(paths.at(0)), paths[0]);
  Header header = first.header();
  header.text.erase("part");
  header.text.erase("cut");
  Output out(output, header);
  uint64_t next = 0;
  for (const std::string& path : paths) {
    Reader reader(open_file(path), path);
    check_same_run(path, first.header(), reader.header());
    Block block;
    while (reader.next(block)) {
      if (block.first_number < next)
        throw std::runtime_error(path + ": record " + std::to_string(block.first_number) +
                                 " does not come behind " + std::to_string(next - 1) +
                                 " of the log before it; name them in their order");
      out.append(block.payload.data(), block.count);
      next = block.first_number +
             (word(block.record(block.count - 1), 0) - static_cast<uint32_t>(block.first_number)) +
             1;
    }
    if (troubles != nullptr && troubles->empty() && !reader.is_whole())
      *troubles = path + ": " + reader.troubles();
  }
  out.close();
  return out.records();
}

}  // namespace firmtouch::log
