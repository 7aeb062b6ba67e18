#pragma once
#include <cstdint>

#include "device/calibrate.hpp"

namespace firmtouch::tools {

struct StudySettings {
  uint32_t runs = 1000, touches = 40;
  double noise_m = 20e-6;
  double links_off = 0.05, zeros_off_rad = 0.02;  // the start's, at most
};

/// Calibrations of a machine whose links are off, from simulated touches: one half as
/// plan_touches() chose them with these links, the other with those that the first half finds.
struct CalibrationStudy {
  uint32_t runs = 0, converged = 0;
  uint32_t in_ellipsoid = 0;         // the truth, of the 95 % ellipsoid
  double median_m = 0, worst_m = 0;  // largest error of the tip over the workspace, of the runs
  double before_m = 0;               // the same median without calibration
  double bound_m = 0;                // least rms error at the worst pose, of these touches
  double scattered_bound_m = 0;      // and of as many anywhere in the ranges
};

CalibrationStudy study_calibration(const LinkageDevice& device, const StudySettings& settings);

}  // namespace firmtouch::tools
