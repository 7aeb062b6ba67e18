#pragma once
#include <utility>
#include <vector>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"

namespace firmtouch::spline_test {

inline tools::SplineModel of(const tools::SplineCurve& curve) {
  tools::SplineModel model;
  model.curves.push_back(curve);
  return model;
}
inline tools::SplineModel of(const std::vector<tools::SplineSurface>& surfaces) {
  tools::SplineModel model;
  model.surfaces = surfaces;
  return model;
}
inline tools::SplineModel of(const tools::SplineSurface& surface) {
  return of(std::vector{surface});
}

/// One piece.
inline tools::SplineCurve bezier(std::vector<tools::ControlPoint> points) {
  tools::SplineCurve curve;
  curve.degree = static_cast<int>(points.size()) - 1;
  curve.points = std::move(points);
  curve.knots.assign(curve.points.size(), 0);
  curve.knots.insert(curve.knots.end(), curve.points.size(), 1);
  return curve;
}

/// The circle of radius 1 in four rational quarters.
inline tools::SplineCurve circle() {
  constexpr double kW = 0.70710678118654752;
  tools::SplineCurve c;
  c.degree = 2;
  c.points = {{1, 0, 0, 1},    {1, 1, 0, kW}, {0, 1, 0, 1},   {-1, 1, 0, kW}, {-1, 0, 0, 1},
              {-1, -1, 0, kW}, {0, -1, 0, 1}, {1, -1, 0, kW}, {1, 0, 0, 1}};
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.t1 = 4;
  return c;
}

/// A model, baked; opened where the baker had no problem with it.
struct BakedModel {
  tools::SplineModel model;
  std::vector<tools::Section> sections;
  tools::SplineReport report;
  spline::View view;

  explicit BakedModel(const tools::SplineModel& from, bool is_small = false) : model(from) {
    const tools::SplineDetail detail =
        model.surfaces.empty() ? tools::curve_detail(is_small) : tools::surface_detail(is_small);
    sections = tools::bake_spline(model, "x", detail, report);
    if (report.problem.empty()) CHECK(tools::open_baked(sections, "x", view).ok());
  }
};

}  // namespace firmtouch::spline_test
