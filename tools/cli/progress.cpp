#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace firmtouch::cli {
namespace {

constexpr std::chrono::seconds kQuietFor(2);
constexpr std::chrono::milliseconds kRedraw(200);
constexpr size_t kBarCells = 24;

}  // namespace

Progress::Progress(size_t stages) : stages_(stages), begin_(std::chrono::steady_clock::now()) {
  if (isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::stage(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++begun_;
  what_ = what;
}

void Progress::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (changed_.wait_for(lock, kQuietFor, [this] { return ended_; })) return;
  do {
    draw(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count());
  } while (!changed_.wait_for(lock, kRedraw, [this] { return ended_; }));
}

void Progress::draw(double elapsed_s) {
  const size_t done = begun_ == 0 ? 0 : begun_ - 1;
  const size_t cells = stages_ == 0 ? 0 : std::min(done, stages_) * kBarCells / stages_;
  std::string bar = stages_ == 0 ? "" : '[' + std::string(kBarCells, '.') + ']';
  if (stages_ != 0) bar.replace(1, cells, cells, '#');
  std::fprintf(stderr, "\r\033[K%s %3.0f s  %s", bar.c_str(), elapsed_s, what_.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace firmtouch::cli
