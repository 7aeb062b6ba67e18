#include <cstdio>

#include "bake/asset/origin.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "footpoint/asset_pieces.hpp"
#include "footpoint/footpoints.hpp"

namespace firmtouch::cli {

void query_footpoints(const spline::View& model, tools::Point origin_m, CsvTable table,
                      const Arguments& arguments) {
  std::vector<tools::BezierCurve> curves;
  std::vector<tools::BezierPatch> patches;
  tools::asset_pieces(model, curves, patches);
  const tools::Footpoints feet(curves, patches, tools::kAssetGap);
  const auto place = [&](size_t row) {
    const float* p = table.row(row);
    return tools::to_point({p[0], p[1], p[2]});
  };
  if (arguments.has("--time")) {
    print_time(table.rows(), arguments, [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) {
        bool is_complete = false;
        sum += static_cast<float>(feet.all(place(i), is_complete).front().distance_m);
      }
      return sum;
    });
    return;
  }
  Rows<std::tuple<size_t, const char*, double, double, double, double, int, double, double>> rows(
      {"point", "kind", "distance", "cx", "cy", "cz", "piece", "u", "v"}, arguments);
  size_t incomplete = 0, first = 0;
  for (size_t i = 0; table.has(i); ++i) {
    bool is_complete = false;
    for (const tools::Footpoint& f : feet.all(place(i), is_complete)) {
      const tools::Point at_m = tools::in_file(f.point_m, origin_m);
      rows.add(
          {i, tools::name_of(f.kind), f.distance_m, at_m.x, at_m.y, at_m.z, f.piece, f.u, f.v});
    }
    if (is_complete) continue;
    if (incomplete++ == 0) first = i;
  }
  rows.finish();
  if (incomplete != 0)
    std::fprintf(
        stderr,
        "firmtouch: query: of %zu %s only some foot-points are listed (first: row %zu, from "
        "0): whole lines of the shape are at one distance there\n",
        incomplete, incomplete == 1 ? "row" : "rows", first);
}

}  // namespace firmtouch::cli
