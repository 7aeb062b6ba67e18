#include "bench/timing.hpp"

#include <time.h>

#include <algorithm>

namespace firmtouch::bench {

namespace {

double now_us() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

}  // namespace

Contender timed(size_t queries, const std::function<double()>& pass) {
  return [queries, pass] {
    volatile double sink = 0;
    const double begin_us = now_us();
    sink = sink + pass();
    return (now_us() - begin_us) / static_cast<double>(queries);
  };
}

Contender median_of_passes(const Contender& contender) {
  return [contender] { return medians_us({contender})[0]; };
}

std::vector<double> medians_us(const std::vector<Contender>& contenders) {
  std::vector<std::vector<double>> us(contenders.size());
  for (size_t pass = 0; pass < kPasses; ++pass)
    for (size_t i = 0; i < contenders.size(); ++i) us[i].push_back(contenders[i]());
  std::vector<double> medians;
  for (std::vector<double>& times : us) {
    std::sort(times.begin(), times.end());
    medians.push_back(times[kPasses / 2]);
  }
  return medians;
}

}  // namespace firmtouch::bench
