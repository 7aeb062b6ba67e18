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

void query_spline(const spline::View& model, CsvTable table, const Arguments& arguments) {
  const auto row_of = [](const spline::Closest& a) {
    return std::make_tuple(a.distance_m, a.point_m.x, a.point_m.y, a.point_m.z, a.piece, a.u, a.v,
                           a.certificate.lower_m, a.certificate.steps, a.certificate.exact);
  };
  answer_rows(
      table, arguments,
      {"distance", "cx", "cy", "cz", "piece", "u", "v", "lower", "steps", "exact"},
      [&] { return Answers(model, arguments); }, row_of);
}

}  // namespace firmtouch::cli
