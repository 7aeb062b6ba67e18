#include <vector>

#include "cli/queries.hpp"
#include "cli/timing.hpp"

namespace firmtouch::cli {

namespace {

math::Vec3 point_of(const float* row) { return {row[0], row[1], row[2]}; }

// Every row's crossings, in order of t. If the buffer is too small for all, it grows and the row is
// queried again.
class AllCrossings {
 public:
  AllCrossings(const LoadedMesh& mesh, query::Budget budget) : mesh_(mesh), budget_(budget) {}

  // Of how many rows the work ended before all of their crossings were found.
  size_t cut_short() const { return cut_short_; }

  core::Span<const mesh::SurfaceCrossing> of(const float* row) {
    const math::Vec3 a_m = point_of(row), b_m = point_of(row + 3);
    mesh::Crossings all = find(a_m, b_m);
    if (all.found > buffer_.size()) {
      buffer_.resize(all.found);
      all = find(a_m, b_m);
    }
    if (!all.exact) ++cut_short_;
    return {buffer_.data(), all.reported};
  }

 private:
  mesh::Crossings find(math::Vec3 a_m, math::Vec3 b_m) {
    return mesh_.wide.all_crossings(a_m, b_m, budget_,
                                    {buffer_.data(), static_cast<uint32_t>(buffer_.size())});
  }

  const LoadedMesh& mesh_;
  query::Budget budget_;
  size_t cut_short_ = 0;
  std::vector<mesh::SurfaceCrossing> buffer_ = std::vector<mesh::SurfaceCrossing>(64);
};

void query_all(const LoadedMesh& mesh, CsvTable& table, const Arguments& arguments) {
  AllCrossings crossings(mesh, budget_of(arguments));
  if (arguments.has("--time")) {
    print_time(table.rows(), arguments, [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i)
        for (const mesh::SurfaceCrossing& c : crossings.of(table.row(i))) sum += c.t;
      return sum;
    });
    return;
  }
  Rows<std::tuple<size_t, float, uint32_t>> rows({"segment", "t", "triangle"}, arguments);
  for (size_t i = 0; table.has(i); ++i)
    for (const mesh::SurfaceCrossing& c : crossings.of(table.row(i)))
      rows.add({i, c.t, mesh.source_of(c.triangle)});
  rows.finish();
  warn_cut_short(crossings.cut_short());
}

}  // namespace

void query_segment(const LoadedMesh& mesh, CsvTable table, const Arguments& arguments) {
  if (arguments.has("--all")) return query_all(mesh, table, arguments);
  const query::Budget budget = budget_of(arguments);
  const auto cast = [&](size_t i) {
    const float* const row = table.row(i);
    return mesh.wide.cast_segment(point_of(row), point_of(row + 3), budget);
  };
  if (arguments.has("--time")) {
    print_time(table.rows(), arguments, [&] {
      float sum = 0;
      for (size_t i = 0; i < table.rows(); ++i) sum += cast(i).t;
      return sum;
    });
    return;
  }
  Rows<std::tuple<bool, float, int64_t, uint32_t, bool>> rows(
      {"hit", "t", "triangle", "steps", "exact"}, arguments);
  for (size_t i = 0; table.has(i); ++i) {
    const mesh::Hit hit = cast(i);
    const int64_t triangle = hit.hit ? int64_t{mesh.source_of(hit.triangle)} : -1;
    rows.add({hit.hit, hit.t, triangle, hit.steps, hit.exact});
  }
  rows.finish();
}

}  // namespace firmtouch::cli
