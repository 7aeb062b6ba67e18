#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace firmtouch::cli {

/// Where a bar stands, in shares: behind `done` that took `before_s`, and `in_stage_s` into a stage
/// of `share`. It goes on as fast as before; in the first stage, whose pace is not known, slower
/// and slower; never to the end of the stage.
double bar_position(double done, double before_s, double share, double in_stage_s);

/// A progress bar on the last line of standard error, from the second second on. Where that is no
/// terminal, a line with the bar every `line_every`. A thread draws it, so that long stages show
/// that they live; nothing else may be printed while it is there.
class Progress {
 public:
  /// `total` of all stages' shares; 0: not known, only time and stage are shown. Nothing is shown
  /// unless `is_shown`.
  explicit Progress(double total, bool is_shown = true,
                    std::chrono::milliseconds line_every = std::chrono::seconds(10));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The next stage begins, with its share of the time; 0: the one before has another text.
  void stage(const std::string& what, double share = 1);

 private:
  void run();
  double elapsed_s() const;
  void draw();

  const double total_;
  const bool on_terminal_;
  const std::chrono::milliseconds first_, every_;  // time to the first drawing, and between two
  const std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::condition_variable changed_;
  double done_ = 0, share_ = 0, stage_began_s_ = 0;
  std::string what_;
  bool ended_ = false;
  bool drawn_ = false;
  std::thread thread_;
};

}  // namespace firmtouch::cli
