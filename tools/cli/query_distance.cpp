#include <algorithm>
#include <cfloat>
#include <cstdio>

#include "bake/asset/origin.hpp"
#include "cli/failure.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"

namespace firmtouch::cli {
namespace {

const char* feature_text(mesh::Feature feature) {
  if (mesh::is_vertex(feature)) return "vertex";
  return mesh::is_edge(feature) ? "edge" : "face";
}

// Rows in order, each warm-started by the one before unless `cold`.
class Answers {
 public:
  Answers(const simd::WideMesh& mesh, const Arguments& arguments)
      : mesh_(mesh), budget_(budget_of(arguments)), cold_(arguments.has("--cold")) {
    if (arguments.has("--band"))
      budget_.band_m =
          static_cast<float>(std::min(arguments.number("--band", 0, 0), double{FLT_MAX}));
  }

  mesh::Closest next(const float* row) {
    if (cold_) hint_ = mesh::Hint{};
    return mesh_.closest_point({row[0], row[1], row[2]}, budget_, hint_);
  }

 private:
  const simd::WideMesh& mesh_;
  query::Budget budget_;
  bool cold_;
  mesh::Hint hint_;
};

auto row_of(const LoadedMesh& mesh, tools::Point origin_m, const mesh::Closest& a) {
  const tools::Point c_m = tools::in_file(tools::to_point(a.point_m), origin_m);
  return std::make_tuple(a.distance_m, static_cast<int>(a.certificate.sign), c_m.x, c_m.y, c_m.z,
                         a.direction.x, a.direction.y, a.direction.z, mesh.source_of(a.triangle),
                         feature_text(a.feature), a.certificate.lower_m, a.certificate.steps,
                         a.certificate.exact);
}

}  // namespace

void choose_isa(const Arguments& arguments) {
  if (!arguments.has("--isa")) return;
  const std::string problem = firmtouch_simd::use_level(arguments.text("--isa", ""));
  if (!problem.empty()) fail_usage(problem);
}

query::Budget budget_of(const Arguments& arguments) {
  query::Budget budget;
  budget.work = arguments.count("--work", UINT32_MAX, 0, UINT32_MAX);
  if (!arguments.has("--budget")) return budget;
  // Visits: accepted in this version. One takes two and a half units on average.
  static bool is_said = false;
  if (!is_said)
    std::fprintf(
        stderr,
        "firmtouch: query: --budget N is now --work N, in work units; a visit counts 2.5\n");
  is_said = true;
  const uint64_t work = uint64_t{arguments.count("--budget", UINT32_MAX, 0, UINT32_MAX)} * 5 / 2;
  budget.work = static_cast<uint32_t>(std::min<uint64_t>(work, UINT32_MAX));
  return budget;
}

void warn_cut_short(size_t rows) {
  if (rows != 0)
    std::fprintf(stderr,
                 "firmtouch: query: the work or the range of floats ended the queries of %zu rows: "
                 "they may cross more; raise --work, or leave it out\n",
                 rows);
}

void query_distance(const LoadedMesh& mesh, tools::Point origin_m, CsvTable table,
                    const Arguments& arguments) {
  answer_rows(
      table, arguments,
      {"distance", "sign", "cx", "cy", "cz", "nx", "ny", "nz", "triangle", "feature", "lower",
       "steps", "exact"},
      [&] { return Answers(mesh.wide, arguments); },
      [&](const mesh::Closest& a) { return row_of(mesh, origin_m, a); });
}

}  // namespace firmtouch::cli
