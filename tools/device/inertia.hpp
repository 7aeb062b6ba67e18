#pragma once
#include "device/moving_points.hpp"

namespace firmtouch::tools {

/// Of a rod's mass over (1 - s)^2, s (1 - s) and s^2, where s goes from 0 to 1 along it.
struct RodMoments {
  double a = 0, b = 0, c = 0;
};
/// In the order of MassModel::rod.
std::vector<RodMoments> moments_of(const LinkageDevice& device);

/// Inertia of the joints: of links, tip, and rotors that no cable parts from them. A rod's follows
/// from its ends' columns alone: a A.A + 2 b A.B + c B.B. Joints that the linkage lacks have 1.
void put_inertia(const LinkageDevice& device, const std::vector<RodMoments>& moments,
                 const MovingPoints& points, double (&mass)[kJoints][kJoints]);

/// Inverse of a symmetric matrix by its adjugate.
/// Result: false if it is not positive definite.
bool invert(const double (&m)[kJoints][kJoints], double (&inverse)[kJoints][kJoints]);

/// What resists the tip in the direction in which it moves most easily: of mass and of the joints'
/// viscous friction, each in its own direction.
struct TipFigures {
  double least_mass_kg = 0;            // 0: the inertia is not positive definite
  double least_damping_N_s_per_m = 0;  // 0: a joint has none
};
TipFigures tip_figures(const LinkageDevice& device, const JointMotion& at);

/// The least of each on a grid over the joints' ranges, ends included, where the tip has the whole
/// force; 0: it has none.
struct RangeFigures : TipFigures {
  uint32_t poses = 0, whole = 0;  // of the grid, and with the whole force
  bool turns = false;             // there are poses of both orientations: a singularity between
};
RangeFigures least_figures(const LinkageDevice& device);

}  // namespace firmtouch::tools
