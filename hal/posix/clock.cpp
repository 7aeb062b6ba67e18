#include "firmtouch/hal/clock.hpp"

#include <time.h>

#include <atomic>
#include <thread>

namespace firmtouch::hal {
namespace {

constexpr uint64_t kNs_per_s = 1000000000;

uint64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * kNs_per_s + static_cast<uint64_t>(now.tv_nsec);
}

}  // namespace

uint32_t clock_us() { return static_cast<uint32_t>(now_ns() / 1000); }

// A process cannot count its own instructions: 0 ticks per 1,000 marks clock_work() as unusable.
uint32_t clock_work() { return 0; }
uint32_t clock_work_per_1000() { return 0; }

// A thread replaces the timer interrupt. Deadlines are absolute: a late tick does not delay the
// next ones.
void clock_start_servo(uint32_t period_us, void (*tick)()) {
  static std::atomic<uint32_t> period{0};
  if (period.exchange(period_us) != 0) return;  // the thread runs
  std::thread([tick] {
    uint64_t next_ns = now_ns();
    for (;;) {
      next_ns += uint64_t{period.load()} * 1000;
      timespec until{};
      until.tv_sec = static_cast<time_t>(next_ns / kNs_per_s);
      until.tv_nsec = static_cast<long>(next_ns % kNs_per_s);
      while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
      }
      tick();
    }
  }).detach();
}

}  // namespace firmtouch::hal
