#pragma once
#include <cstddef>
#include <cstdio>

#include "bench/timing.hpp"

namespace firmtouch::cli {

/// Runs `pass` (all queries once, result: a sum of the answers, so that none is optimised away)
/// five times and prints the median as `us_per_query 0.1234 queries 20000`. `queries` is at
/// least 1.
template <class Pass>
void print_time(size_t queries, const Pass& pass) {
  const bench::Contender contender =
      bench::timed(queries, [&] { return static_cast<double>(pass()); });
  std::printf("us_per_query %.4f queries %zu\n", bench::medians_us({contender})[0], queries);
}

}  // namespace firmtouch::cli
