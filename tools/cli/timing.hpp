#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace firmtouch::cli {

/// Runs `pass` (all queries once, result: a sum of the answers, so that none is optimised away)
/// five times and prints the median as `us_per_query 0.1234 queries 20000`. `queries` is at
/// least 1.
template <class Pass>
void print_time(size_t queries, const Pass& pass) {
  constexpr size_t kPasses = 5;
  std::vector<double> us;
  volatile float sink = 0;
  for (size_t k = 0; k < kPasses; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    sink = sink + pass();
    const auto end = std::chrono::steady_clock::now();
    us.push_back(std::chrono::duration<double, std::micro>(end - begin).count());
  }
  std::sort(us.begin(), us.end());
  std::printf("us_per_query %.4f queries %zu\n", us[kPasses / 2] / static_cast<double>(queries),
              queries);
}

}  // namespace firmtouch::cli
