#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/log_json.hpp"
#include "cli/npy.hpp"
#include "cli/progress.hpp"
#include "log/edit.hpp"
#include "log/file_sink.hpp"
#include "log/plot.hpp"
#include "log/reader.hpp"
#include "log/statistics.hpp"

namespace firmtouch::cli {
namespace {

// Text to a file that takes its name when it is whole, or to standard output.
class TextOutput {
 public:
  explicit TextOutput(std::string path) : path_(std::move(path)) {
    if (path_.empty() || path_ == "-") return;
    file_ = std::fopen(partial().c_str(), "wb");
    if (file_ == nullptr) fail_input(path_ + ": cannot be written; is its folder there?");
  }
  ~TextOutput() {
    if (file_ == nullptr) return;
    std::fclose(file_);
    remove_partial();
  }
  TextOutput(const TextOutput&) = delete;
  TextOutput& operator=(const TextOutput&) = delete;
  void add(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), file_ != nullptr ? file_ : stdout);
  }
  void close() {
    if (file_ == nullptr) return;
    const bool is_good = std::ferror(file_) == 0 && std::fclose(file_) == 0;
    file_ = nullptr;
    if (is_good && std::rename(partial().c_str(), path_.c_str()) == 0) return;
    remove_partial();
    fail_input(path_ + ": cannot be written; is the disk full?");
  }

 private:
  std::string partial() const { return log::is_special(path_) ? path_ : path_ + ".partial"; }
  void remove_partial() const {
    if (!log::is_special(path_)) std::remove(partial().c_str());
  }
  std::string path_;
  std::FILE* file_ = nullptr;
};

std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> list;
  for (size_t at = 0; at < text.size();) {
    const size_t comma = std::min(text.find(',', at), text.size());
    if (comma > at) list.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return list;
}

// What befell the log goes to stderr, and the answer is no.
int reported(const std::string& path, const std::string& troubles) {
  if (troubles.empty()) return kDone;
  std::fprintf(stderr, "firmtouch: %s: %s\n", path.c_str(), troubles.c_str());
  return kAnswerIsNo;
}

int info(const std::string& path, bool is_json) {
  log::Reader reader(log::open_file(path), path);
  log::read_through(reader);
  const log::Header& header = reader.header();
  if (is_json) {
    std::fputs(json_of(reader).c_str(), stdout);
    return reported(path, reader.troubles());
  }
  std::printf("%s: %llu records of %u bytes in %u blocks, %llu missing\n", path.c_str(),
              static_cast<unsigned long long>(reader.records()), header.record_bytes,
              reader.blocks(), static_cast<unsigned long long>(reader.missing()));
  if (header.decimation > 1) std::printf("every %u-th tick only\n", header.decimation);
  for (const auto& [key, text] : header.text) {
    const size_t end = text.find('\n');
    std::printf("  %-20s %s%s\n", log::printable(key).c_str(),
                log::printable(text.substr(0, end)).c_str(),
                end == std::string::npos ? "" : " ...");
  }
  std::printf("\n  %-26s %-8s %s\n", "field", "unit", "stored as");
  constexpr const char* kTypes[] = {"u32", "i32", "f32"};
  for (const log::Field& field : header.fields) {
    char scale[64] = "";
    if (field.scale < 1 || field.scale > 1 || field.zero < 0 || field.zero > 0)
      std::snprintf(scale, sizeof scale, ", unit = stored * %.9g + %.9g", field.scale, field.zero);
    const std::string count = field.count > 1 ? " x " + std::to_string(field.count) : "";
    std::printf("  %-26s %-8s %s%s%s\n", field.name.c_str(), field.unit.c_str(),
                kTypes[static_cast<int>(field.type)], count.c_str(), scale);
  }
  std::string field;
  for (const log::Bit& bit : header.bits) {
    if (bit.field != field) std::printf("\n  bits of %s\n", bit.field.c_str());
    field = bit.field;
    std::printf("    %2u  %s\n", bit.bit, bit.what.c_str());
  }
  return reported(path, reader.troubles());
}

std::vector<log::Column> columns_of(const std::string& path, const log::Header& header,
                                    const std::vector<std::string>& names) {
  const std::vector<log::Column> all = header.columns();
  if (names.empty()) return all;
  std::vector<log::Column> chosen;
  for (const std::string& name : names) {
    const size_t before = chosen.size();
    for (const log::Column& column : all)
      if (column.name == name || column.field->name == name) chosen.push_back(column);
    if (chosen.size() == before)
      fail_input(path + ": its records have no field " + name + "; `firmtouch log " + path +
                 " info` lists them");
  }
  return chosen;
}

// With --names: the fields whose set bits are named behind the columns.
std::vector<const log::Field*> bit_fields(const log::Header& header,
                                          const std::vector<log::Column>& columns,
                                          const Arguments& arguments) {
  std::vector<const log::Field*> list;
  if (!arguments.has("--names")) return list;
  for (const log::Field& field : header.fields)
    for (const log::Column& column : columns)
      if (field.unit == "bits" && column.field->name == field.name) list.push_back(&field);
  return list;
}

int csv(const std::string& path, const Arguments& arguments) {
  log::Reader reader(log::open_file(path), path);
  const std::vector<log::Column> columns =
      columns_of(path, reader.header(), list_of(arguments.text("--fields", "")));
  TextOutput out(arguments.text("-o", ""));
  std::string text;
  for (const log::Column& column : columns) {
    std::string name = column.name;
    std::replace(name.begin(), name.end(), ',', ';');  // a name of this project has none
    text += (text.empty() ? "" : ",") + name;
  }
  const std::vector<const log::Field*> bits = bit_fields(reader.header(), columns, arguments);
  for (const log::Field* field : bits) text += "," + field->name + "_names";
  out.add(text + "\n");
  log::Block block;
  while (reader.next(block)) {
    text.clear();
    for (uint32_t i = 0; i < block.count; ++i) {
      const uint8_t* record = block.record(i);
      for (const log::Column& column : columns)
        text += (&column == &columns.front() ? "" : ",") + log::stored_text(column, record);
      for (const log::Field* field : bits)
        text += "," + reader.header().names(field->name, log::word(record, field->offset));
      text += "\n";
    }
    out.add(text);
  }
  out.close();
  return reported(path, reader.troubles());
}

// Two passes: the head of the file has the count of its records.
int npy(const std::string& path, const Arguments& arguments) {
  log::Reader counted(log::open_file(path), path);
  log::read_through(counted);
  log::Reader reader(log::open_file(path), path);
  const std::vector<log::Column> columns =
      columns_of(path, reader.header(), list_of(arguments.text("--fields", "")));
  constexpr const char* kTypes[] = {"<u4", "<i4", "<f4"};
  std::vector<NpyColumn> named;
  for (const log::Column& column : columns)
    named.push_back({log::printable(column.name), kTypes[static_cast<int>(column.field->type)]});
  TextOutput out(arguments.text("-o", ""));
  out.add(npy_head(named, counted.records()));
  log::Block block;
  while (reader.next(block)) {
    std::string bytes;
    for (uint32_t i = 0; i < block.count; ++i)
      for (const log::Column& column : columns)
        bytes.append(reinterpret_cast<const char*>(block.record(i)) + column.offset, 4);
    out.add(bytes);
  }
  out.close();
  return reported(path, reader.troubles());
}

int plot(const std::string& path, const Arguments& arguments) {
  const std::string output = arguments.text("-o", "");
  const std::string extension = extension_of(output);
  if (extension != ".svg" && extension != ".html")
    fail_usage("log: plot wants -o FILE.svg or -o FILE.html");
  std::string troubles;
  const std::string text =
      log::plot(path, list_of(arguments.text("--fields", "")), extension == ".html", &troubles);
  write_file(output, text.data(), text.size());
  return reported(path, troubles);
}

// A record's number, or a time as "2.5s".
uint64_t place_of(const std::string& path, const std::string& name, const std::string& text,
                  uint64_t otherwise) {
  if (text.empty()) return otherwise;
  char* end = nullptr;
  if (text.back() == 's') {
    const double seconds = std::strtod(text.c_str(), &end);
    if (end == text.c_str() + text.size() - 1 && seconds >= 0) return log::number_at(path, seconds);
  } else if (text.find_first_not_of("0123456789") == std::string::npos) {
    return std::strtoull(text.c_str(), &end, 10);
  }
  fail_usage("log: " + name + " " + text + ": wanted a record's number, or a time as 2.5s");
}

int cut(const std::string& path, const Arguments& arguments, const std::string& output) {
  const uint64_t from = place_of(path, "--from", arguments.text("--from", ""), 0);
  const uint64_t to = place_of(path, "--to", arguments.text("--to", ""), UINT64_MAX);
  std::string troubles;
  const uint64_t records = log::cut(path, from, to, output, &troubles);
  std::fprintf(stderr, "%s: %llu records\n", output.c_str(),
               static_cast<unsigned long long>(records));
  return reported(path, troubles);
}

int join(const std::vector<std::string>& words, const std::string& output) {
  std::vector<std::string> paths = {words[0]};
  paths.insert(paths.end(), words.begin() + 2, words.end());
  for (const std::string& path : paths) forbid_overwriting(output, path);
  std::string troubles;
  const uint64_t records = log::join(paths, output, &troubles);
  std::fprintf(stderr, "%s: %llu records\n", output.c_str(),
               static_cast<unsigned long long>(records));
  if (!troubles.empty()) std::fprintf(stderr, "firmtouch: %s\n", troubles.c_str());
  return troubles.empty() ? kDone : kAnswerIsNo;
}

int stats(const std::string& path, bool is_json) {
  log::Reader reader(log::open_file(path), path);
  const log::Statistics statistics = log::statistics_of(reader);
  const std::string text = is_json ? json_of(statistics) : text_of(statistics);
  std::fputs(text.c_str(), stdout);
  return statistics.troubles.empty() ? kDone : kAnswerIsNo;
}

void allow(const Arguments& arguments, const std::string& action,
           const std::vector<std::string>& allowed) {
  for (const char* option : {"-o", "--fields", "--names", "--from", "--to", "--json"}) {
    bool is_allowed = false;
    for (const std::string& name : allowed) is_allowed |= name == option;
    if (arguments.has(option) && !is_allowed)
      fail_usage("log: " + std::string(option) + " has no meaning for " + action);
  }
}

int act(const Arguments& arguments) {
  const std::vector<std::string>& words = arguments.positionals();
  const std::string path = words[0], action = words[1], output = arguments.text("-o", "");
  if (action != "join" && words.size() > 2)
    fail_usage("log: one word too many: '" + words[2] + "' (join alone takes several logs)");
  if ((action == "cut" || action == "join") && output.empty())
    fail_usage("log: " + action + " wants -o FILE.ftl");
  if (!output.empty()) forbid_overwriting(output, path);
  if (action == "info")
    return allow(arguments, action, {"--json"}), info(path, arguments.has("--json"));
  if (action == "csv")
    return allow(arguments, action, {"-o", "--fields", "--names"}), csv(path, arguments);
  if (action == "npy") return allow(arguments, action, {"-o", "--fields"}), npy(path, arguments);
  if (action == "plot") return allow(arguments, action, {"-o", "--fields"}), plot(path, arguments);
  if (action == "cut")
    return allow(arguments, action, {"-o", "--from", "--to"}), cut(path, arguments, output);
  if (action == "join") return allow(arguments, action, {"-o"}), join(words, output);
  if (action == "stats")
    return allow(arguments, action, {"--json"}), stats(path, arguments.has("--json"));
  fail_usage("log: '" + action +
             "' is nothing to do with a log: info, csv, npy, plot, cut, join, stats");
}

}  // namespace

Command log_command() {
  return {
      {"log", "LOG.ftl info|csv|npy|plot|cut|join|stats [LOG.ftl...]", 2, 1000, run_log},
      "Prints what a recorded run holds, draws it, cuts and joins.",
      R"(  info    the head of the log and its fields     csv    every record as a row, as stored
  stats   period, steps, faults, missing records  plot   force, position, deviation, energy, steps
  cut     the records from --from to before --to  join   this log and those that follow it
  npy     the same rows as a NumPy file
A damaged or cut-off log gives all its whole blocks; exit code 1 then.)",
      {{"-o", "FILE",
        "where to: .ftl for cut and join, .svg or .html for plot, text for csv, .npy (- is "
        "stdout)"},
       {"--fields", "A,B", "csv, npy, plot: these fields alone, by their names in the log"},
       {"--names", nullptr, "csv: further columns with the names of the set bits"},
       {"--from", "N|S", "cut: from this record's number on, or from a time: 2.5s"},
       {"--to", "N|S", "cut: to before this record's number, or this time"},
       {"--json", nullptr, "info, stats: for programs"}}};
}

int run_log(const Arguments& arguments) {
  try {
    return act(arguments);
  } catch (const std::runtime_error& error) {
    fail_input(error.what());
  }
}

}  // namespace firmtouch::cli
