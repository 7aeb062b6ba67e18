#include "bake/spline/spline_choice.hpp"

#include <cmath>

#include "bake/spline/spline_worst.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint32_t kWalks = 60, kQueries = 50;  // each from anywhere
constexpr double kStep = 0.002;                 // of the extent, a query
constexpr query::Budget kMax{2000};
constexpr uint64_t kCurveBytes = 5000;
constexpr double kMaxDoubt = 8;

// Of straight walks within a quarter of the extent about the model's box.
double work_of(const spline::View& model) {
  const spline::Head& head = model.head();
  const auto extent_m = static_cast<double>(head.extent_m);
  Random random(11);
  double work = 0;
  for (uint32_t walk = 0; walk < kWalks; ++walk) {
    double at[3];
    for (size_t k = 0; k < 3; ++k)
      at[k] = random.between(static_cast<double>(head.low_m[k]) - 0.25 * extent_m,
                             static_cast<double>(head.high_m[k]) + 0.25 * extent_m);
    const Point from{at[0], at[1], at[2]}, way{random.bell(), random.bell(), random.bell()};
    const Point step = way * (kStep * extent_m / std::sqrt(dot(way, way)));
    spline::Hint hint;
    for (uint32_t i = 0; i <= kQueries; ++i) {
      const spline::Closest c = closest_point(model, to_vec3(from + step * i), kMax, hint);
      if (i > 0)
        work += cortex_m7_instructions(model.is_surface(), c.certificate.steps, c.evaluations);
    }
  }
  return work;
}

double work_of(const std::vector<Section>& sections, const std::string& name) {
  spline::View view;
  const bool is_open = open_baked(sections, name, view).ok();
  return is_open ? work_of(view) : HUGE_VAL;
}

// Pieces with weights are cut less often where the curve is then of the size that is aimed at.
std::vector<Section> bake_fast_curve(const SplineModel& model, const std::string& name,
                                     bool is_small, SplineReport& report) {
  SplineDetail detail = curve_detail(is_small);
  std::vector<Section> finest = bake_spline(model, name, detail, report);
  if (!report.problem.empty() || !report.is_rational || is_small) return finest;
  SplineReport coarser = report;
  for (std::vector<Section> made = finest; coarser.problem.empty() && detail.doubt <= kMaxDoubt;) {
    if (coarser.bytes <= kCurveBytes) {
      report = coarser;
      return made;
    }
    detail.doubt *= 2;
    made = bake_spline(model, name, detail, coarser);
  }
  return finest;
}

}  // namespace

std::vector<Section> bake_fast_spline(const SplineModel& model, const std::string& name,
                                      bool is_small, SplineReport& report) {
  if (model.surfaces.empty()) return bake_fast_curve(model, name, is_small, report);
  SplineDetail detail = surface_detail(is_small);
  std::vector<Section> best = bake_spline(model, name, detail, report);
  if (!report.problem.empty() || is_small) return best;
  detail.cell_level = 0;
  SplineReport other;
  std::vector<Section> larger = bake_spline(model, name, detail, other);
  if (!other.problem.empty() || !(work_of(larger, name) <= work_of(best, name))) return best;
  report = other;
  return larger;
}

}  // namespace firmtouch::tools
