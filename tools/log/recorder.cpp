#include "log/recorder.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>

#if defined(__linux__)
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "log/file_sink.hpp"

namespace firmtouch::log {
namespace {

constexpr auto kNap = std::chrono::milliseconds(5);  // 50 records at 10 kHz
constexpr int kNice = 10;

// Below whatever makes the records: where both want the processor, this one waits.
void lower_priority() {
#if defined(__linux__)
  const id_t thread = static_cast<id_t>(::syscall(SYS_gettid));
  if (::setpriority(PRIO_PROCESS, thread, kNice) != 0) return;  // then as it is: slower, not wrong
#endif
}

}  // namespace

std::string part_path(const std::string& path, uint32_t part) {
  if (part == 0) return path;
  const std::filesystem::path whole = path;
  char number[16];
  std::snprintf(number, sizeof number, ".%04u", part + 1);
  return (whole.parent_path() / (whole.stem().string() + number + whole.extension().string()))
      .string();
}

Recorder::Recorder(Records& records, Header header, DrainOptions options, Drain::Make make,
                   Drain::Remove remove)
    : drain_(records, std::move(header), options, std::move(make), std::move(remove)),
      thread_([this] { run(); }) {}

Recorder::Recorder(Records& records, Header header, DrainOptions options, const std::string& path)
    : Recorder(
          records, std::move(header), options,
          [path](uint32_t part, std::string& problem) {
            return make_file(part_path(path, part), problem);
          },
          [path](uint32_t part) { std::remove(part_path(path, part).c_str()); }) {}

Recorder::~Recorder() { stop(); }

void Recorder::run() {
  lower_priority();
  const auto begin = std::chrono::steady_clock::now();
  uint32_t reported = 0;
  while (!is_stopping_.load(std::memory_order_acquire)) {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begin;
    const bool is_more = drain_.step(now.count());
    if (drain_.totals().failures != reported) {
      reported = drain_.totals().failures;
      const std::lock_guard<std::mutex> lock(mutex_);
      trouble_ = drain_.totals().problem;
    }
    if (!is_more) std::this_thread::sleep_for(kNap);
  }
}

std::string Recorder::trouble() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(trouble_, std::string());
}

bool Recorder::stop() {
  if (!thread_.joinable()) return is_closed_;
  is_stopping_.store(true, std::memory_order_release);
  thread_.join();
  return is_closed_ = drain_.finish();
}

}  // namespace firmtouch::log
