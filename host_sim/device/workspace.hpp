#pragma once
#include <cstdint>

#include "device/inertia.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

using tools::JointMotion;
using tools::LinkageDevice;

/// Poses of a linkage on a grid over the ranges of its joints.
struct Workspace {
  uint32_t poses = 0, reachable = 0;
  uint32_t with_whole_force = 0, with_faded_force = 0;  // of the reachable ones
  Vec low_m, high_m;                                    // box about the tip
  double worst_condition = 1;                           // the least reciprocal one
  double worst_at_rad[device::kMaxJoints] = {};
  bool changes_orientation = false;  // the Jacobian's determinant has both signs
  // Where the whole force is rendered:
  double least_force_N = 0;    // that the torque limits allow in every direction
  double lasting_force_N = 0;  // the same while all motors are hot
  double count_m = 0;          // longest motion of the tip by one count
  uint32_t massless = 0;       // poses whose inertia is not positive definite
  double least_mass_kg = 0;    // that the tip has in any direction of the others
  JointMotion lightest_at;     // the pose where it has it
};

/// `steps` + 1 angles a joint, ends included.
Workspace workspace_of(const LinkageDevice& device, uint32_t steps);

/// The stiffest wall at which what the observer of energy does not predict, and does not see of a
/// count, stays within 1 mJ with its reservoir: the least mass and the longest count decide.
/// Derivation: firmware/firmtouch/servo/README.md.
double stiffest_wall_N_per_m(const Workspace& workspace, double period_s);

/// Every pose is reachable and none is at or beyond the fade's end; no singularity lies between
/// poses, because the Jacobian's determinant keeps its sign.
bool is_free_of_singularities(const Workspace& workspace);

}  // namespace firmtouch::host_sim
