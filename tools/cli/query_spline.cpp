#include <cstdio>

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
  const auto wide = [](float value) { return static_cast<double>(value); };
  const auto print = [&](const spline::Closest& a) {
    std::printf("%.9g,%.9g,%.9g,%.9g,%u,%.9g,%.9g,%.9g,%u,%d\n", wide(a.distance_m),
                wide(a.point_m.x), wide(a.point_m.y), wide(a.point_m.z), a.piece, wide(a.u),
                wide(a.v), wide(a.certificate.lower_m), a.certificate.steps,
                a.certificate.exact ? 1 : 0);
  };
  answer_rows(
      table, arguments, "distance,cx,cy,cz,piece,u,v,lower,steps,exact",
      [&] { return Answers(model, arguments); }, print);
}

}  // namespace firmtouch::cli
