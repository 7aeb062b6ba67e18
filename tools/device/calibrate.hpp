#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "device/moving_points.hpp"
#include "device/symmetric.hpp"

namespace firmtouch::tools {

/// The tip touched something whose place is known in the linkage's frame. Without normal and radius
/// a point; with a normal a plate through `at_m`; with a radius a ball around it.
struct Touch {
  double counts[device::kMaxJoints] = {};
  Point at_m, normal;
  double radius_m = 0;
};

/// A parameter of the device file, in SI.
struct Calibrated {
  std::string name;
  const char* unit;
  double before = 0, value = 0;
  double deviation = 0;       // standard deviation; of one that is not determined meaningless
  bool is_determined = true;  // false: the touches leave it, alone or with others, open
};

struct Calibration {
  LinkageDevice device;
  std::vector<Calibrated> parameters;
  Directions directions;      // of J^T J, scaled; the first `determined` have a variance of
  std::vector<double> scale;  // noise_m^2 / value, in parameters / scale
  uint32_t determined = 0;
  double noise_m = 0;
  uint32_t equations = 0;
  double rms_m = 0;            // of the residuals
  bool has_converged = false;  // and the residuals are at most three times the noise
};

/// A direction whose deviation would exceed this is not determined. Lengths are scaled by 0.1 m,
/// angles by a radian, counts by themselves.
constexpr double kMaxDeviation = 0.02;

/// Lengths, offsets and zero angles, with `with_counts` also counts per rad, by Levenberg and
/// Marquardt's least squares. Directions in the space of parameters that are not determined stay
/// as they are. Where the touches are not fitted, other starts about the nominal one are tried.
/// `noise_m`: standard deviation of a touch, in each coordinate.
/// Error: the covariance against 1,000 noisy runs (`firmtouch calibrate --study`).
Calibration calibrate(const LinkageDevice& nominal, const std::vector<Touch>& touches,
                      double noise_m, bool with_counts);

/// The linkage at the counts of a touch.
MovingPoints points_at(const LinkageDevice& device, const Touch& touch);

/// Derivatives of the touches' equations by the scaled parameters, a column each, by central
/// differences. Result: empty where the links do not meet.
Matrix sensitivity(LinkageDevice device, const std::vector<Touch>& touches, bool with_counts);

/// The parameters, in the order of Calibration::parameters.
std::vector<double> parameters_of(const LinkageDevice& device, bool with_counts);

/// Distance of `truth` in deviations, squared, along what is determined; with the right covariance
/// chi-squared of `determined` degrees of freedom.
double deviations2(const Calibration& calibration, const std::vector<double>& truth);

/// The 95 % quantile of chi-squared (Wilson and Hilferty), within 0.2 % from 4 degrees on.
double chi2_95(uint32_t degrees);

}  // namespace firmtouch::tools
