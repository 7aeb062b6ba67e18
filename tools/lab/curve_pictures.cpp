#include <cmath>

#include "bench/curve_cases.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "lab/picture.hpp"
#include "lab/pictures.hpp"

namespace firmtouch::lab {
namespace {

using tools::Point;

constexpr double kTurn = 6.283185307179586;
constexpr int kSamples = 400, kTicks = 400;
constexpr char kDevice[] = "stroke=\"#283\" stroke-width=\"1.6\"";
constexpr char kConstraint[] = "stroke=\"#c33\" stroke-width=\"2\"";
constexpr char kCurve[] = "stroke=\"#aaa\" stroke-width=\"4\"";
constexpr char kPair[] = "stroke=\"black\" stroke-width=\"0.5\"";

// A hairpin: two strands 8 mm apart, 100 mm long, that wave and are joined by half a circle.
// `share`: of the way from one end to the other.
Point on_curve(double share) {
  constexpr double kHalfGap_m = 0.004, kStrand_m = 0.1;
  constexpr double kBend_m = kTurn / 2 * kHalfGap_m, kLength_m = 2 * kStrand_m + kBend_m;
  const double s_m = share * kLength_m;
  const auto strand = [&](double along_m, double side_m) {
    return Point{along_m - kStrand_m / 2, side_m + 0.005 * std::sin(kTurn * along_m / kStrand_m),
                 0};
  };
  if (s_m < kStrand_m) return strand(s_m, kHalfGap_m);
  if (s_m > kStrand_m + kBend_m) return strand(kLength_m - s_m, -kHalfGap_m);
  const double angle = kTurn / 4 - (s_m - kStrand_m) / kHalfGap_m;
  return Point{kStrand_m / 2 + kHalfGap_m * std::cos(angle), kHalfGap_m * std::sin(angle), 0};
}

// A hand that is led along and twice on each strand strays 6.5 mm toward the other strand.
Point of_device(double share) {
  const Point p = on_curve(share);
  const double side = share < 0.5 ? -1 : 1;
  const double astray_m = 0.0065 * std::pow(std::sin(kTurn * 2 * share), 2);
  return p + Point{0, side * astray_m, 0};
}

void draw(const Options& options, const curve::View& view, float weight_m, const std::string& name,
          Report& report) {
  Picture picture({-0.056, -0.014, 0}, {0.06, 0.014, 0}, false);
  std::vector<Point> track, device, constraint;
  for (int k = 0; k <= kSamples; ++k) track.push_back(on_curve(static_cast<double>(k) / kSamples));
  picture.line(track, kCurve);
  curve::Following following;
  size_t jumps = 0;
  for (int k = 0; k <= kTicks; ++k) {
    const Point p = of_device(static_cast<double>(k) / kTicks);
    const curve::Hold hold{weight_m, 1e9f};
    const Point found =
        tools::to_point(follow(view, tools::to_vec3(p), hold, query::kUnlimited, following)
                            .constraint.closest.point_m);
    jumps += !constraint.empty() && length(found - constraint.back()) > 0.003 ? 1u : 0u;
    device.push_back(p), constraint.push_back(found);
    picture.line({p, found}, kPair);
  }
  picture.line(device, kDevice);
  picture.line(constraint, kConstraint);
  report.figure("jumps of the constraint over 3 mm", name, static_cast<double>(jumps), "");
  write_picture(options, name, picture, report);
}

}  // namespace

void draw_curve_figures(const Options& options, Report& report) {
  report.heading("curves, figure 3: device and constraint, drawn into " + options.figures);
  std::vector<math::Vec3> samples;
  for (int k = 0; k < kSamples; ++k)
    samples.push_back(tools::to_vec3(on_curve(static_cast<double>(k) / kSamples)));
  const CurveCase curve = bake_case(samples, "hairpin");
  draw(options, curve.view, 0.3f * curve.view.head().length_m, "curve-figure-3", report);
  draw(options, curve.view, 0.0f, "curve-figure-3-without-penalty", report);
}

}  // namespace firmtouch::lab
