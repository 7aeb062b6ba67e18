#pragma once
// Curves baked and opened as guides, for tests.
#include <cstring>
#include <utility>
#include <vector>

#include "bake/spline/bake_spline.hpp"
#include "bake/spline/spline_guide.hpp"
#include "harness/test.hpp"

namespace firmtouch::spline_test {

struct Guide {
  tools::SplineModel model;
  std::vector<tools::Section> sections, lengths;
  tools::SplineGuideReport report;
  spline::View view;
  spline::GuideView guide;

  explicit Guide(std::vector<tools::SplineCurve> curves) {
    model.curves = std::move(curves);
    for (size_t i = 0; i < model.curves.size(); ++i) model.curves[i].piece = static_cast<int>(i);
    tools::SplineReport of_bake;
    sections = tools::bake_spline(model, "x", tools::curve_detail(false), of_bake);
    CHECK(tools::open_baked(sections, "x", view).ok());
    lengths = tools::bake_spline_guide(view, "x", report);
    CHECK_EQ(lengths.size(), 2u);
    CHECK(spline::open_guide(view, parts(), guide).ok());
  }
  spline::GuideSections parts() const { return {bytes(0), bytes(1)}; }
  core::Verdict verdict() const {
    spline::GuideView opened;
    return spline::open_guide(view, parts(), opened);
  }
  std::vector<float> arcs() const {
    std::vector<float> made(lengths[0].bytes.size() / 4);
    std::memcpy(made.data(), lengths[0].bytes.data(), lengths[0].bytes.size());
    return made;
  }
  void set_arcs(const std::vector<float>& arcs) {
    lengths[0] = tools::make_section(spline::kArcsSection, "x", arcs);
  }
  void set_chains(const std::vector<spline::Chain>& chains) {
    lengths[1] = tools::make_section(spline::kChainsSection, "x", chains);
  }

 private:
  core::Bytes bytes(size_t i) const {
    return {lengths[i].bytes.data(), static_cast<uint32_t>(lengths[i].bytes.size())};
  }
};

inline tools::SplineCurve through(std::vector<tools::ControlPoint> points, int degree) {
  tools::SplineCurve curve;
  curve.degree = degree;
  curve.points = std::move(points);
  const size_t inner = curve.points.size() - static_cast<size_t>(degree);
  curve.knots.assign(static_cast<size_t>(degree), 0.0);
  for (size_t i = 0; i <= inner; ++i) curve.knots.push_back(static_cast<double>(i));
  curve.knots.insert(curve.knots.end(), static_cast<size_t>(degree), static_cast<double>(inner));
  curve.t0 = 0, curve.t1 = static_cast<double>(inner);
  return curve;
}

/// Two strands 4 mm apart, joined 0.2 m away, as a polygon.
inline tools::SplineCurve hairpin() {
  return through({{0, 0, 0, 1}, {0.2, 0, 0, 1}, {0.2, 0.004, 0, 1}, {0, 0.004, 0, 1}}, 1);
}

/// A closed eight that crosses itself in the middle.
inline tools::SplineCurve eight() {
  return through({{0, 0, 0, 1},
                  {1, 1, 0, 1},
                  {2, 0, 0, 1},
                  {1, -1, 0, 1},
                  {0, 0, 0, 1},
                  {-1, 1, 0, 1},
                  {-2, 0, 0, 1},
                  {-1, -1, 0, 1},
                  {0, 0, 0, 1}},
                 2);
}

}  // namespace firmtouch::spline_test
