#include "bake/asset/step_figures.hpp"

#include <algorithm>

#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint64_t kSeed = 1;

float between(Random& random, float low, float high) {
  const double margin = 0.25 * (static_cast<double>(high) - static_cast<double>(low));
  return static_cast<float>(
      random.between(static_cast<double>(low) - margin, static_cast<double>(high) + margin));
}

float mix(float a, float b, double t) {
  return static_cast<float>(static_cast<double>(a) * (1 - t) + static_cast<double>(b) * t);
}

}  // namespace

StepFigures measure_steps(const float (&low_m)[3], const float (&high_m)[3],
                          const std::vector<math::Vec3>& path_m,
                          const std::function<uint32_t(math::Vec3, bool)>& steps_of) {
  Random random(kSeed);
  StepFigures figures;
  uint64_t total = 0;
  for (uint32_t i = 0; i < kFigureQueries; ++i) {
    float at[3];
    for (int k = 0; k < 3; ++k) at[k] = between(random, low_m[k], high_m[k]);
    const uint32_t steps = steps_of({at[0], at[1], at[2]}, true);
    figures.random_worst = std::max(figures.random_worst, steps);
    total += steps;
  }
  figures.random_mean = static_cast<double>(total) / kFigureQueries;

  total = 0;
  for (size_t i = 0; i < path_m.size(); ++i) {
    const uint32_t steps = steps_of(path_m[i], i == 0);
    if (i > 0) figures.path_worst = std::max(figures.path_worst, steps);  // the first one is cold
    total += steps;
  }
  figures.path_mean =
      path_m.empty() ? 0 : static_cast<double>(total) / static_cast<double>(path_m.size());
  return figures;
}

std::vector<math::Vec3> path_along(const std::vector<math::Vec3>& polyline_m, float diagonal_m) {
  std::vector<math::Vec3> path;
  const double aside_m = 0.005 * static_cast<double>(diagonal_m);
  for (uint32_t i = 0; i < kFigureQueries; ++i) {
    const double at = static_cast<double>(polyline_m.size() - 1) * i / kFigureQueries;
    const auto segment = static_cast<size_t>(at);
    const double t = at - static_cast<double>(segment);
    const math::Vec3 a = polyline_m[segment];
    const math::Vec3 b = polyline_m[std::min(segment + 1, polyline_m.size() - 1)];
    path.push_back({mix(a.x, b.x, t), mix(a.y, b.y, t),
                    static_cast<float>(static_cast<double>(mix(a.z, b.z, t)) + aside_m)});
  }
  return path;
}

void add_steps(const StepFigures& steps, Facts& facts) {
  facts.push_back({"steps_random_mean", number_text(steps.random_mean)});
  facts.push_back({"steps_random_worst", std::to_string(steps.random_worst)});
  facts.push_back({"steps_path_mean", number_text(steps.path_mean)});
  facts.push_back({"steps_path_worst", std::to_string(steps.path_worst)});
}

}  // namespace firmtouch::tools
