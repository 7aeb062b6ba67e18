#include "bench/curve_cases.hpp"

#include <chrono>
#include <utility>

#include "bench/open_or_throw.hpp"
#include "bench/points_about.hpp"
#include "bench/problem.hpp"
#include "firmtouch/math/elementary.hpp"
#include "surface/random.hpp"

namespace firmtouch::bench {

std::vector<math::Vec3> make_track(uint32_t samples, uint32_t power) {
  tools::Random random(7);
  std::vector<double> at;
  double sum = 0;
  for (uint32_t i = 0; i < samples; ++i) {
    at.push_back(sum);
    const double u = random.uniform();
    double step = 1;
    for (uint32_t k = 0; k < power; ++k) step *= u;
    sum += step + 1e-6;
  }
  std::vector<math::Vec3> points;
  for (const double s : at) {
    const auto k = static_cast<float>(s / sum * 6.283185307179586);
    const float r_m = 0.1f * (1.0f + 0.4f * math::cosine(7.0f * k));
    points.push_back(
        {r_m * math::cosine(3.0f * k), r_m * math::sine(2.0f * k), 0.03f * math::sine(7.0f * k)});
  }
  return points;
}

CurveCase bake_case(std::vector<math::Vec3> samples_m, const std::string& name, bool is_smooth) {
  CurveCase made;
  made.name = name;
  tools::CurvePoints points;
  points.samples_m = std::move(samples_m);
  points.is_smooth = is_smooth;
  points.with_tree = true;
  const auto start = std::chrono::steady_clock::now();
  made.sections = tools::bake_curve(points, "curve", made.report);
  made.bake_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!made.report.problem.empty()) throw Problem(name + ": " + made.report.problem);
  open_or_throw(made.sections, "curve", name + ": its curve", made.view);
  made.samples_m = std::move(points.samples_m);
  return made;
}

std::vector<math::Vec3> random_points(const CurveCase& curve, size_t count) {
  return points_about(curve.view.head(), count, 1);
}

}  // namespace firmtouch::bench
