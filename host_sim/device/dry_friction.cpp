#include "host_sim/device/dry_friction.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

constexpr int kRounds = 50, kSweeps = 4;

// Each torque in turn, the others as they are (projected Gauss-Seidel).
void sweep(uint32_t joints, const double (&change)[kJoints][kJoints], const double (&rate)[kJoints],
           const double (&most_Nm)[kJoints], double (&torque_Nm)[kJoints]) {
  for (int i = 0; i < kSweeps; ++i)
    for (uint32_t k = 0; k < joints; ++k) {
      double left = rate[k];
      for (uint32_t j = 0; j < joints; ++j) left -= change[k][j] * torque_Nm[j];
      torque_Nm[k] = std::clamp(torque_Nm[k] + left / change[k][k], -most_Nm[k], most_Nm[k]);
    }
}

}  // namespace

// Joints that rest: their part of `change`, among them alone, times their torques is the rate left.
bool DryFriction::fulfil(uint32_t joints, const double (&change)[kJoints][kJoints],
                         const double (&rate)[kJoints], const double (&most_Nm)[kJoints],
                         double (&torque_Nm)[kJoints]) const {
  double left[kJoints] = {}, part[kJoints][kJoints] = {}, inverse[kJoints][kJoints];
  bool has_rest = false;
  for (uint32_t k = 0; k < joints; ++k) torque_Nm[k] = slides_[k] * most_Nm[k];
  for (uint32_t k = 0; k < joints; ++k) {
    has_rest |= slides_[k] == 0;
    left[k] = rate[k];
    for (uint32_t j = 0; j < joints; ++j) left[k] -= change[k][j] * torque_Nm[j];
  }
  if (has_rest) {
    for (uint32_t i = 0; i < kJoints; ++i)
      for (uint32_t j = 0; j < kJoints; ++j)
        part[i][j] =
            slides_[i] == 0 && slides_[j] == 0 && i < joints && j < joints ? change[i][j] : i == j;
    if (!tools::invert(part, inverse)) return false;
    for (uint32_t k = 0; k < joints; ++k)
      for (uint32_t j = 0; j < joints; ++j)
        if (slides_[k] == 0 && slides_[j] == 0) torque_Nm[k] += inverse[k][j] * left[j];
    for (uint32_t k = 0; k < joints; ++k)
      for (uint32_t j = 0; j < joints; ++j)
        if (slides_[j] == 0) left[k] -= change[k][j] * torque_Nm[j];
  }
  bool holds = true;
  for (uint32_t k = 0; k < joints; ++k)
    holds &= slides_[k] == 0 ? std::fabs(torque_Nm[k]) <= most_Nm[k]
                             : left[k] * slides_[k] >= 0 || !(most_Nm[k] > 0);
  return holds;
}

void DryFriction::torques(uint32_t joints, const double (&change)[kJoints][kJoints],
                          const double (&rate)[kJoints], const double (&most_Nm)[kJoints],
                          double (&torque_Nm)[kJoints]) {
  if (fulfil(joints, change, rate, most_Nm, torque_Nm)) return;
  double swept_Nm[kJoints] = {};
  for (int round = 0; round < kRounds; ++round) {
    sweep(joints, change, rate, most_Nm, swept_Nm);
    for (uint32_t k = 0; k < joints; ++k)
      slides_[k] = swept_Nm[k] >= most_Nm[k] ? 1 : swept_Nm[k] <= -most_Nm[k] ? -1 : 0;
    if (fulfil(joints, change, rate, most_Nm, torque_Nm)) return;
  }
  for (uint32_t k = 0; k < joints; ++k) torque_Nm[k] = swept_Nm[k];
}

}  // namespace firmtouch::host_sim
