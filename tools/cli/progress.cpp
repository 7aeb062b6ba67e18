#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace firmtouch::cli {
namespace {

constexpr std::chrono::milliseconds kQuietFor(2000), kRedraw(200);
constexpr size_t kBarCells = 24;

constexpr double kFirstStage_s = 4, kMaxOfStage = 0.97;

}  // namespace

double bar_position(double done, double before_s, double share, double in_stage_s) {
  const double into = done > 0 && before_s > 0
                          ? done / before_s * in_stage_s
                          : share * (1 - std::exp(-in_stage_s / kFirstStage_s));
  return done + std::min(into, kMaxOfStage * share);
}

Progress::Progress(double total, bool is_shown, std::chrono::milliseconds line_every)
    : total_(total),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      first_(on_terminal_ ? kQuietFor : line_every),
      every_(on_terminal_ ? kRedraw : line_every),
      begin_(std::chrono::steady_clock::now()) {
  if (is_shown) thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
  if (drawn_ && on_terminal_) std::fputs("\r\033[K", stderr);
}

double Progress::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Progress::stage(const std::string& what, double share) {
  const std::lock_guard<std::mutex> lock(mutex_);
  what_ = what;
  if (share <= 0) return;
  done_ += share_;
  share_ = share;
  stage_began_s_ = elapsed_s();
}

void Progress::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (changed_.wait_for(lock, first_, [this] { return ended_; })) return;
  do {
    draw();
  } while (!changed_.wait_for(lock, every_, [this] { return ended_; }));
}

void Progress::draw() {
  const double now_s = elapsed_s();
  std::string bar;
  if (total_ > 0) {
    const double at = bar_position(done_, stage_began_s_, share_, now_s - stage_began_s_) / total_;
    const size_t cells = static_cast<size_t>(std::min(at, 1.0) * kBarCells);
    bar = '[' + std::string(cells, '#') + std::string(kBarCells - cells, '.') + ']';
  }
  std::fprintf(stderr, on_terminal_ ? "\r\033[K%s %3.0f s  %s" : "%s %3.0f s  %s\n", bar.c_str(),
               now_s, what_.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace firmtouch::cli
