#pragma once
#include <cstddef>
#include <cstdio>

#include "bench/timing.hpp"
#include "cli/arguments.hpp"
#include "cli/csv_table.hpp"
#include "cli/rows.hpp"

namespace firmtouch::cli {

/// Runs `pass` (all queries once, result: a sum of the answers, so that none is optimised away)
/// five times and prints the median as `us_per_query 0.1234 queries 20000`. `queries` is at
/// least 1; with --json as an object.
template <class Pass>
void print_time(size_t queries, const Arguments& arguments, const Pass& pass) {
  const bench::Contender contender =
      bench::timed(queries, [&] { return static_cast<double>(pass()); });
  std::printf(arguments.has("--json") ? "{\"us_per_query\": %.4f, \"queries\": %zu}\n"
                                      : "us_per_query %.4f queries %zu\n",
              bench::medians_us({contender})[0], queries);
}

/// Answers each row of `table` in order by what make() returns: timed with --time, else printed as
/// the tuple row_of(answer), whose columns are `names`.
template <size_t N, class Make, class RowOf>
void answer_rows(CsvTable& table, const Arguments& arguments, const char* const (&names)[N],
                 const Make& make, const RowOf& row_of) {
  if (arguments.has("--time")) {
    print_time(table.rows(), arguments, [&] {
      auto answers = make();
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) sum += answers.next(table.row(i)).distance_m;
      return sum;
    });
    return;
  }
  auto answers = make();
  Rows<decltype(row_of(answers.next(nullptr)))> rows(names, arguments);
  for (size_t i = 0; table.has(i); ++i) rows.add(row_of(answers.next(table.row(i))));
  rows.finish();
}

}  // namespace firmtouch::cli
