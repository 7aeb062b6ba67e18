#pragma once
#include <cstddef>
#include <cstdio>

#include "bench/timing.hpp"
#include "cli/arguments.hpp"
#include "cli/csv_table.hpp"

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

/// Answers each row of `table` in order by what make() returns: timed with --time, else printed by
/// print(answer) below `header`.
template <class Make, class Print>
void answer_rows(CsvTable& table, const Arguments& arguments, const char* header, const Make& make,
                 const Print& print) {
  if (arguments.has("--time")) {
    print_time(table.rows(), [&] {
      auto answers = make();
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) sum += answers.next(table.row(i)).distance_m;
      return sum;
    });
    return;
  }
  std::puts(header);
  auto answers = make();
  for (size_t i = 0; table.has(i); ++i) print(answers.next(table.row(i)));
}

}  // namespace firmtouch::cli
