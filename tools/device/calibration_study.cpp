#include "device/calibration_study.hpp"

#include <algorithm>
#include <cmath>

#include "device/calibration_plan.hpp"

namespace firmtouch::tools {
namespace {

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

void add_noise(double noise_m, bool is_planar, Chance& chance, std::vector<Touch>& touches) {
  for (Touch& touch : touches) touch.at_m = touch.at_m + chance.noise(is_planar) * noise_m;
}

// What `device` touches at the counts of a plan on `nominal`.
std::vector<Touch> planned(const LinkageDevice& device, const LinkageDevice& nominal,
                           uint32_t count, double noise_m) {
  std::vector<Touch> plan = plan_touches(nominal, count, noise_m);
  for (Touch& touch : plan)
    touch.at_m =
        touch.at_m + points_at(device, touch).tip.at_m - points_at(nominal, touch).tip.at_m;
  return plan;
}

// Half of the touches are planned on a machine whose links are off, the others on the one that the
// first half finds.
std::vector<Touch> planned_twice(const LinkageDevice& device, const StudySettings& settings) {
  Chance chance(0);
  const LinkageDevice nominal = spoiled(device, settings, chance);
  const uint32_t half = settings.touches / 2;
  std::vector<Touch> all = planned(device, nominal, half, settings.noise_m), first = all;
  add_noise(settings.noise_m, device.joints.joints == 2, chance, first);
  const LinkageDevice found = calibrate(nominal, first, settings.noise_m, false).device;
  for (const Touch& touch : planned(device, found, settings.touches - half, settings.noise_m))
    all.push_back(touch);
  return all;
}

// The largest error of the tip at the same counts.
double worst_error_m(const LinkageDevice& truth, const LinkageDevice& found) {
  double worst_m = 0;
  for (const JointMotion& at : grid_poses(truth)) {
    JointMotion also;
    for (uint32_t k = 0; k < truth.joints.joints; ++k) {
      const device::JointSetting &joint = truth.joints.joint[k], &other = found.joints.joint[k];
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
  const std::vector<Touch> plan = planned_twice(device, settings);
  study.bound_m = least_error_m(device, plan, settings.noise_m);
  Chance any(1);
  std::vector<Touch> scattered;
  for (uint32_t i = 0; i < settings.touches; ++i)
    scattered.push_back(touch_at(device, random_pose(device, any), i, any));
  study.scattered_bound_m = least_error_m(device, scattered, settings.noise_m);
  for (uint32_t run = 0; run < settings.runs; ++run) {
    Chance chance(run + 1);
    std::vector<Touch> touches = plan;
    add_noise(settings.noise_m, device.joints.joints == 2, chance, touches);
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
