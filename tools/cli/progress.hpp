#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace firmtouch::cli {

/// A progress bar on the last line of standard error, where that is a terminal and the work takes
/// more than two seconds. A thread draws it, so that long stages show that they live; nothing else
/// may be printed while it is there.
class Progress {
 public:
  /// `stages` 0: how many there will be is not known, and only time and stage are shown.
  explicit Progress(size_t stages);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The next stage begins.
  void stage(const std::string& what);

 private:
  void run();
  void draw(double elapsed_s);

  const size_t stages_;
  const std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t begun_ = 0;
  std::string what_;
  bool ended_ = false;
  bool drawn_ = false;
  std::thread thread_;  // only on a terminal
};

}  // namespace firmtouch::cli
