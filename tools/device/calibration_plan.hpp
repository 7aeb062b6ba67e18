#pragma once
#include <cstdint>
#include <random>
#include <vector>

#include "device/calibrate.hpp"
#include "device/moving_points.hpp"

namespace firmtouch::tools {

/// Random numbers that are the same everywhere; those of the library's distributions are not.
class Chance {
 public:
  explicit Chance(uint32_t seed) : engine_(seed) {}
  double share();   // within 0 and 1
  double normal();  // of deviation 1
  Point noise(bool is_planar);

 private:
  std::mt19937 engine_;
};

/// A touch at a pose; by `number` of a point, a plate, or a ball of 10 mm, in turn, from anywhere.
Touch touch_at(const LinkageDevice& device, const JointMotion& at, uint32_t number, Chance& chance);
JointMotion random_pose(const LinkageDevice& device, Chance& chance);

/// Which touches determine the parameters best: of points, plates and balls in turn, out of 300
/// candidates each, half of them at the ends of the ranges. D-optimal by exchange (Fedorov 1972):
/// by the equivalence theorem of Kiefer and Wolfowitz, about the smallest largest error too.
std::vector<Touch> plan_touches(const LinkageDevice& device, uint32_t count, double noise_m);

/// Poses on a grid over the ranges, their ends included.
std::vector<JointMotion> grid_poses(const LinkageDevice& device);

/// Cramer and Rao's bound: no unbiased estimate from these touches has a smaller rms error of the
/// tip, at the worst pose of the grid.
double least_error_m(const LinkageDevice& device, const std::vector<Touch>& touches,
                     double noise_m);

}  // namespace firmtouch::tools
