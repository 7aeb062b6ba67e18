#include <cstdio>

#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::cli {

void query_segment(const LoadedMesh& mesh, const CsvTable& table, const Arguments& arguments) {
  const query::Budget budget = budget_of(arguments);
  const auto cast = [&](size_t i) {
    const float* row = table.row(i);
    return mesh::cast_segment(mesh.view, {row[0], row[1], row[2]}, {row[3], row[4], row[5]},
                              budget);
  };
  if (arguments.has("--time")) {
    print_time(table.rows(), [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) sum += cast(i).t;
      return sum;
    });
    return;
  }
  std::puts("hit,t,triangle,steps");
  for (size_t i = 0; i < table.rows(); ++i) {
    const mesh::Hit hit = cast(i);
    const int64_t triangle = hit.hit ? int64_t{mesh.source_of(hit.triangle)} : -1;
    std::printf("%d,%.9g,%lld,%u\n", hit.hit ? 1 : 0, static_cast<double>(hit.t),
                static_cast<long long>(triangle), hit.steps);
  }
}

}  // namespace firmtouch::cli
