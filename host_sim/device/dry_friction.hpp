#pragma once
#include "device/inertia.hpp"

namespace firmtouch::host_sim {

using tools::kJoints;

/// Coulomb friction of joints in one step: a joint's torque brings it to rest, or it is the most
/// that the joint has, against the rate that is left.
class DryFriction {
 public:
  /// `rate`: of each joint after the step without friction; less change x torques with it. `most`:
  /// of each torque; 0: the joint has none.
  /// Which joints rest, and which way the others slide, is seldom another than in the call before:
  /// then the torques follow in closed form. Else sweeps find which do.
  /// Pre: `change` is symmetric and positive definite in its first `joints` rows.
  /// Error: a rate that should be 0 is within 1e-12
  /// (host_sim.DryFriction_AnyHistory_FulfilsItsConditions).
  void torques(uint32_t joints, const double (&change)[kJoints][kJoints],
               const double (&rate)[kJoints], const double (&most_Nm)[kJoints],
               double (&torque_Nm)[kJoints]);

 private:
  // The torques if joints rest and slide as slides_ says. Result: whether they fulfil the above.
  bool fulfil(uint32_t joints, const double (&change)[kJoints][kJoints],
              const double (&rate)[kJoints], const double (&most_Nm)[kJoints],
              double (&torque_Nm)[kJoints]) const;

  int slides_[kJoints] = {1, 1, 1};  // sign of the torque; 0: rests
};

}  // namespace firmtouch::host_sim
