#include "bench/curve_force.hpp"

#include <algorithm>
#include <cmath>

#include "bench/curve_cases.hpp"
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/scene/curve_guide.hpp"
#include "firmtouch/servo/evaluate.hpp"

namespace firmtouch::bench {
namespace {

constexpr double kAside_m = 0.003, kStep_m = 0.0001;
constexpr float kStiffness_N_per_m = 400.0f;
constexpr float kRelease_m = 0.03f;

// A ring of 50 mm that waves up and down, of a few samples.
constexpr double kRing_m = 0.05, kWave_m = 0.01;
constexpr uint32_t kRingSamples = 40;

math::Vec3 on_ring(double angle, double aside_m) {
  const auto k = static_cast<float>(angle);
  const auto r_m = static_cast<float>(kRing_m + aside_m);
  return {r_m * math::cosine(k), r_m * math::sine(k),
          static_cast<float>(kWave_m) * math::sine(3.0f * k)};
}

// The greatest change of the force from one tick to the next, in parts of the force.
double force_step(const CurveCase& curve, double aside_m) {
  scene::CurveGuide guide;
  guide.curve = &curve.view;
  guide.material = {kStiffness_N_per_m, 0.0f};
  guide.snap_m = guide.release_m = kRelease_m;
  guide.arc_penalty = 0.1f;
  scene::CurveGuideTouch touch;
  servo::LocalModel model;
  math::Vec3 before;
  double worst = 0;
  const double tick_angle = kStep_m / (kRing_m + std::abs(aside_m));
  for (int i = 0; i * tick_angle < 6.2; ++i) {
    const math::Vec3 p_m = on_ring(i * tick_angle, aside_m);
    scene::begin_model(model, p_m, 0, 1);
    follow_curve(guide, p_m, query::kUnlimited, touch, model);
    const math::Vec3 now = servo::evaluate(model, p_m, {});
    const double change =
        std::hypot(double{now.x} - double{before.x}, double{now.y} - double{before.y},
                   double{now.z} - double{before.z});
    if (i > 0)
      worst = std::max(worst, change / std::hypot(double{now.x}, double{now.y}, double{now.z}));
    before = now;
  }
  return worst;
}

}  // namespace

void run_force_steps(Report& report) {
  report.heading("force from tick to tick, 1 kHz, 100 mm/s, 3 mm beside a ring of 40 samples");
  std::vector<math::Vec3> samples;
  for (uint32_t i = 0; i < kRingSamples; ++i)
    samples.push_back(on_ring(6.283185307179586 * i / kRingSamples, 0));
  samples.push_back(samples.front());
  for (const bool is_smooth : {false, true}) {
    const CurveCase curve =
        bake_case(samples, is_smooth ? "cubic pieces" : "straight pieces", is_smooth);
    for (const double aside_m : {kAside_m, -kAside_m}) {
      const char* const what = aside_m > 0 ? "most step of the force, outside" : "inside";
      const double percent = 100 * force_step(curve, aside_m);
      if (is_smooth)
        report.bar(what, curve.name, percent, "%", 1);
      else
        report.figure(what, curve.name, percent, "%");
    }
  }
}

}  // namespace firmtouch::bench
