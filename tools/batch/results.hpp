#pragma once
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "batch/shard.hpp"

namespace firmtouch::tools {

/// Two batches differ where one of these does: the number of all runs, and a hash of what they
/// depend on.
struct BatchIdentity {
  uint64_t runs = 0;
  uint64_t hash = 0;
};

/// A batch's results, as CSV: "run,runs,batch," and the columns of `header`, a row a run, in the
/// order of the runs, whichever ends first. At any moment the file is a beginning of the whole one,
/// apart from a row that is not whole; a file that is there is gone on with.
class BatchResults {
 public:
  /// Throws Refused if the file is of another batch or shard, is written by one, or cannot be.
  BatchResults(const std::string& path, const std::string& header, BatchIdentity batch,
               Shard shard);
  /// How many of the shard's runs the file had.
  uint64_t had() const { return had_; }
  /// From any thread: the row of the shard's `nth` run. Throws Refused if the file takes no more.
  void add(uint64_t nth, const std::string& row);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void write(const std::string& text);

  std::string path_;
  BatchIdentity batch_;
  Shard shard_;
  std::unique_ptr<std::FILE, Close> file_;
  uint64_t had_ = 0, next_ = 0;
  std::mutex mutex_;
  std::map<uint64_t, std::string> waiting_;  // rows of runs behind one that has not ended
};

/// The results of all shards as those of one batch: the same bytes. `files`: path and content.
/// Throws Refused where a file is of another batch, or a run is missing or there twice.
std::string merged(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace firmtouch::tools
