#pragma once
#include <cstdint>

#include "cli/arguments.hpp"
#include "cli/csv_table.hpp"
#include "cli/loaded_asset.hpp"
#include "firmtouch/query/certificate.hpp"
#include "surface/point.hpp"

namespace firmtouch::cli {

/// --budget: unlimited unless given.
query::Budget budget_of(const Arguments& arguments);

/// Of a query of every crossing: warns where the work ended some rows' queries.
void warn_cut_short(size_t rows);

struct CurveOptions {
  bool is_exact = true;  // else the published way: of the N nearest samples
  uint32_t nearest = 0;
  float arc_penalty_m = 0;
};
/// --mode, --n and --arc-penalty.
CurveOptions curve_options_of(const Arguments& arguments);

/// --mode and --base of a hull: fails (usage) on what has no meaning.
void check_hull_options(const Arguments& arguments);
/// Of a hull's query: segment, ray or triangle; fails (usage) on another.
std::string primitive_of(const Arguments& arguments);

/// Applies --isa. Fails (usage) where this processor has no such level.
void choose_isa(const Arguments& arguments);

// One a kind of query: answers every row of `table`, which counts from `origin_m`, on standard
// output, or times them.
void query_distance(const LoadedMesh& mesh, tools::Point origin_m, CsvTable table,
                    const Arguments& arguments);
void query_segment(const LoadedMesh& mesh, CsvTable table, const Arguments& arguments);
void query_hull(const LoadedHull& hull, CsvTable table, const Arguments& arguments);
void query_curve(const LoadedCurve& curve, tools::Point origin_m, CsvTable table,
                 const Arguments& arguments);
void query_spline(const spline::View& model, tools::Point origin_m, CsvTable table,
                  const Arguments& arguments);
void query_footpoints(const spline::View& model, tools::Point origin_m, CsvTable table,
                      const Arguments& arguments);

}  // namespace firmtouch::cli
