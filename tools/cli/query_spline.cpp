#include "bake/asset/origin.hpp"
#include "cli/queries.hpp"
#include "cli/timing.hpp"
#include "firmtouch/spline/closest_point.hpp"

namespace firmtouch::cli {
namespace {

// Rows in order, each warm-started by the one before unless `cold`.
class Answers {
 public:
  Answers(const spline::View& model, const Arguments& arguments)
      : model_(model), budget_(budget_of(arguments)), cold_(arguments.has("--cold")) {}

  spline::Closest next(const float* row) {
    if (cold_) hint_ = spline::Hint{};
    return spline::closest_point(model_, {row[0], row[1], row[2]}, budget_, hint_);
  }

 private:
  const spline::View& model_;
  query::Budget budget_;
  bool cold_;
  spline::Hint hint_;
};

}  // namespace

void query_spline(const spline::View& model, tools::Point origin_m, CsvTable table,
                  const Arguments& arguments) {
  const auto row_of = [&](const spline::Closest& a) {
    const tools::Point c_m = tools::in_file(tools::to_point(a.point_m), origin_m);
    return std::make_tuple(a.distance_m, c_m.x, c_m.y, c_m.z, a.piece, a.u, a.v,
                           a.certificate.lower_m, a.certificate.steps, a.certificate.exact);
  };
  answer_rows(
      table, arguments,
      {"distance", "cx", "cy", "cz", "piece", "u", "v", "lower", "steps", "exact"},
      [&] { return Answers(model, arguments); }, row_of);
}

}  // namespace firmtouch::cli
