#include "device/calibration_study.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "device/moving_points.hpp"

namespace firmtouch::tools {
namespace {

constexpr int kGrid = 6;  // poses a joint, over its range
constexpr double kBall_m = 0.01;

double wide(float a) { return static_cast<double>(a); }

class Chance {
 public:
  explicit Chance(uint32_t seed) : engine_(seed) {}
  double share() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }
  double normal() {
    return std::sqrt(-2 * std::log(share())) * std::cos(6.283185307179586 * share());
  }
  Point way(bool is_planar) {
    const Point any{normal(), normal(), is_planar ? 0 : normal()};
    return any * (1 / length(any));
  }

 private:
  std::mt19937 engine_;  // the same everywhere; the library's distributions are not
};

Touch touch_at(const LinkageDevice& device, uint32_t number, double noise_m, Chance& chance) {
  const bool is_planar = device.joints.joints == 2;
  Touch touch;
  JointMotion at;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    at.angle_rad[k] =
        wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * chance.share();
    touch.counts[k] = (at.angle_rad[k] - wide(joint.zero_rad)) * wide(joint.counts_per_rad);
  }
  const Point tip_m = points_of(device, at).tip.at_m, way = chance.way(is_planar);
  const Point noise{chance.normal(), chance.normal(), is_planar ? 0 : chance.normal()};
  touch.at_m = tip_m + noise * noise_m;
  if (number % 3 == 1) touch.normal = way;
  if (number % 3 == 2) {
    touch.radius_m = kBall_m;
    touch.at_m = touch.at_m + way * kBall_m;
  }
  return touch;
}

// The start of a calibration: links and zero angles that are off.
LinkageDevice spoiled(LinkageDevice device, const StudySettings& settings, Chance& chance) {
  const auto off = [&](float& length_m) {
    length_m *= static_cast<float>(1 + settings.links_off * (2 * chance.share() - 1));
  };
  std::visit(
      [&](auto& linkage) {
        using Kind = std::decay_t<decltype(linkage)>;
        if constexpr (std::is_same_v<Kind, device::FiveBar>) {
          for (int k = 0; k < 2; ++k) off(linkage.proximal_m[k]), off(linkage.distal_m[k]);
        } else if constexpr (std::is_same_v<Kind, device::SerialArm>) {
          for (float& link_m : linkage.link_m) off(link_m);
        } else {
          for (int k = 0; k < 3; ++k) off(linkage.upper_m[k]), off(linkage.lower_m[k]);
        }
      },
      device.linkage);
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    device.joints.joint[k].zero_rad +=
        static_cast<float>(settings.zeros_off_rad * (2 * chance.share() - 1));
  return device;
}

// The largest error of the tip at the same counts.
double worst_error_m(const LinkageDevice& truth, const LinkageDevice& found) {
  double worst_m = 0;
  const int last = truth.joints.joints == 3 ? kGrid : 1;
  for (int i = 0; i < kGrid * kGrid * last; ++i) {
    const int step[] = {i % kGrid, i / kGrid % kGrid, i / kGrid / kGrid};
    JointMotion at, also;
    for (uint32_t k = 0; k < truth.joints.joints; ++k) {
      const device::JointSetting &joint = truth.joints.joint[k], &other = found.joints.joint[k];
      at.angle_rad[k] = wide(joint.low_rad) +
                        (wide(joint.high_rad) - wide(joint.low_rad)) * step[k] / (kGrid - 1);
      const double counts = (at.angle_rad[k] - wide(joint.zero_rad)) * wide(joint.counts_per_rad);
      also.angle_rad[k] = wide(other.zero_rad) + counts / wide(other.counts_per_rad);
    }
    const MovingPoints a = points_of(truth, at), b = points_of(found, also);
    if (!b.is_closed) return HUGE_VAL;
    worst_m = std::max(worst_m, length(a.tip.at_m - b.tip.at_m));
  }
  return worst_m;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

CalibrationStudy study_calibration(const LinkageDevice& device, const StudySettings& settings) {
  CalibrationStudy study;
  std::vector<double> errors_m, before_m;
  for (uint32_t run = 0; run < settings.runs; ++run) {
    Chance chance(run + 1);
    std::vector<Touch> touches;
    for (uint32_t i = 0; i < settings.touches; ++i)
      touches.push_back(touch_at(device, i, settings.noise_m, chance));
    const LinkageDevice start = spoiled(device, settings, chance);
    const Calibration found = calibrate(start, touches, settings.noise_m, false);
    ++study.runs;
    study.converged += found.has_converged ? 1 : 0;
    if (deviations2(found, parameters_of(device, false)) <= chi2_95(found.determined))
      ++study.in_ellipsoid;
    errors_m.push_back(worst_error_m(device, found.device));
    before_m.push_back(worst_error_m(device, start));
  }
  study.median_m = median(errors_m);
  study.before_m = median(before_m);
  for (const double error_m : errors_m) study.worst_m = std::max(study.worst_m, error_m);
  return study;
}

}  // namespace firmtouch::tools
