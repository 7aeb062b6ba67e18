#pragma once
#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "log/drain.hpp"

namespace firmtouch::log {

/// A thread of low priority that takes a ring's records to files. Whoever fills the ring never
/// waits for it: what the ring cannot hold while the disk stalls is dropped, counted, and missing
/// in the log at its place.
class Recorder {
 public:
  /// The first file is `path`; further ones `stem.0002.ftl` and so on beside it.
  Recorder(Records& records, Header header, DrainOptions options, const std::string& path);
  /// To files of the caller's kind.
  Recorder(Records& records, Header header, DrainOptions options, Drain::Make make,
           Drain::Remove remove);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes what is left and closes the log. Result: false where the disk refused; totals() says
  /// why.
  bool stop();
  /// What the disk refused since the last call; the records wait in the ring and the write is
  /// repeated. Empty if nothing was refused.
  std::string trouble();
  /// After stop().
  const DrainTotals& totals() const { return drain_.totals(); }

 private:
  void run();

  Drain drain_;
  std::atomic<bool> is_stopping_{false};
  std::mutex mutex_;
  std::string trouble_;  // guarded by mutex_
  bool is_closed_ = false;
  std::thread thread_;
};

/// "run.ftl", then "run.0002.ftl", ...
std::string part_path(const std::string& path, uint32_t part);

}  // namespace firmtouch::log
