#include "firmtouch/hal/clock.hpp"

#include <time.h>

#include <atomic>
#include <thread>

#include "firmtouch/hal/pace.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint64_t kNs_per_s = 1000000000;

uint64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * kNs_per_s + static_cast<uint64_t>(now.tv_nsec);
}

// With simulated joints time is simulated too: a tick that this machine delays is not late.
std::atomic<uint64_t> g_simulated_ns{0};  // 0: time is real

}  // namespace

uint32_t clock_us() {
  const uint64_t simulated_ns = g_simulated_ns;
  return static_cast<uint32_t>((simulated_ns != 0 ? simulated_ns : now_ns()) / 1000);
}

// A process cannot count its own instructions: 0 ticks per 1,000 marks clock_work() as unusable.
uint32_t clock_work() { return 0; }
uint32_t clock_work_per_1000() { return 0; }

void pace_tick() {
  if (g_simulated_ns == 0) g_simulated_ns = now_ns();
}

// A thread replaces the timer interrupt. Deadlines are absolute: a late tick does not delay the
// next ones.
void clock_start_servo(uint32_t period_us, void (*tick)()) {
  static std::atomic<uint32_t> period{0};
  if (period.exchange(period_us) != 0) return;  // the thread runs
  std::thread([tick] {
    uint64_t next_ns = now_ns();
    for (;;) {
      const uint64_t period_ns = uint64_t{period.load()} * 1000;
      next_ns += period_ns;
      timespec until{};
      until.tv_sec = static_cast<time_t>(next_ns / kNs_per_s);
      until.tv_nsec = static_cast<long>(next_ns % kNs_per_s);
      while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
      }
      if (g_simulated_ns != 0) g_simulated_ns += period_ns;
      tick();
    }
  }).detach();
}

}  // namespace firmtouch::hal
