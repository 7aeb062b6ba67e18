#include "bench/timing.hpp"

#include <algorithm>
#include <chrono>

namespace firmtouch::bench {

Contender timed(size_t queries, const std::function<double()>& pass) {
  return [queries, pass] {
    volatile double sink = 0;
    const auto begin = std::chrono::steady_clock::now();
    sink = sink + pass();
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::micro>(end - begin).count() /
           static_cast<double>(queries);
  };
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
