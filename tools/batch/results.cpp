#include "batch/results.hpp"

#include <sys/file.h>

#include <algorithm>
#include <cinttypes>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "device/refused.hpp"

namespace firmtouch::tools {
namespace {

std::string beginning_of(uint64_t run, BatchIdentity batch) {
  char text[80];
  std::snprintf(text, sizeof text, "%" PRIu64 ",%" PRIu64 ",%016" PRIx64 ",", run, batch.runs,
                batch.hash);
  return text;
}

std::string line_at(const std::string& text, size_t at) {
  return text.substr(at, text.find('\n', at) - at);
}

}  // namespace

BatchResults::BatchResults(const std::string& path, const std::string& header, BatchIdentity batch,
                           Shard shard)
    : path_(path), batch_(batch), shard_(shard) {
  const std::string first = "run,runs,batch," + header + "\n";
  file_.reset(std::fopen(path.c_str(), "ab"));
  if (file_ == nullptr)
    throw Refused(path + ": it cannot be written: name a file in a folder that exists");
  if (flock(fileno(file_.get()), LOCK_EX | LOCK_NB) != 0)
    throw Refused(path + ": another batch is writing it");
  std::ostringstream had;
  had << std::ifstream(path, std::ios::binary).rdbuf();
  std::string text = had.str();
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0
  const auto other = [&](const std::string& what) {
    return Refused(path + ": " + what + "; remove it, or write to another file with -o");
  };
  if (!text.empty() && text.compare(0, first.size(), first) != 0)
    throw other("it is not of this batch: it has other columns");
  for (size_t at = first.size(); at < text.size(); at = text.find('\n', at) + 1, ++had_) {
    const std::string expected = beginning_of(shard.run(had_), batch);
    if (had_ >= shard.runs(batch.runs) || text.compare(at, expected.size(), expected) != 0)
      throw other("it is not of this batch and shard: '" + line_at(text, at).substr(0, 60) + "'");
  }
  next_ = had_;
  std::filesystem::resize_file(path, text.size());
  if (text.empty()) write(first);
}

void BatchResults::write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
      std::fflush(file_.get()) != 0)
    throw Refused(path_ + ": it takes no more: is the disk full?");
}

void BatchResults::add(uint64_t nth, const std::string& row) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_[nth] = beginning_of(shard_.run(nth), batch_) + row + "\n";
  for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
    write(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
  }
}

std::string merged(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string header, batch;
  std::map<uint64_t, std::string> rows;
  uint64_t runs = 0;
  for (const auto& [path, text] : files) {
    const std::string first = line_at(text, 0);
    if (first.compare(0, 15, "run,runs,batch,") != 0 || text.back() != '\n')
      throw Refused(path + ": it is no whole result of a batch");
    if (header.empty()) header = first;
    for (size_t at = first.size() + 1; at < text.size(); at = text.find('\n', at) + 1) {
      const std::string row = line_at(text, at);
      uint64_t run = 0;
      char hash[20] = "";
      if (std::sscanf(row.c_str(), "%" SCNu64 ",%" SCNu64 ",%16[0-9a-f],", &run, &runs, hash) != 3)
        throw Refused(path + ": '" + row.substr(0, 60) + "' is no row of a batch");
      if (batch.empty()) batch = std::to_string(runs) + hash;
      if (batch != std::to_string(runs) + hash || first != header)
        throw Refused(path + ": it is of another batch than " + files[0].first);
      if (!rows.emplace(run, row).second)
        throw Refused(path + ": run " + std::to_string(run) + " is in an earlier file, too");
    }
  }
  std::string text = header + "\n";
  for (uint64_t run = 0; run < std::max<uint64_t>(runs, 1); ++run) {
    if (rows.count(run) == 0)
      throw Refused("run " + std::to_string(run) +
                    " is in no file: has its shard come to its end?");
    text += rows[run] + "\n";
  }
  return text;
}

}  // namespace firmtouch::tools
