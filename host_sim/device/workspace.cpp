#include "host_sim/device/workspace.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/params/table.hpp"
#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {
namespace {

using tools::to_point;

struct Determinants {
  bool positive = false, negative = false;
};

double wide(float a) { return static_cast<double>(a); }

double determinant(const device::Pose& pose, uint32_t joints) {
  const Vec a = to_point(pose.column_m[0]), b = to_point(pose.column_m[1]);
  const Vec c = joints == 2 ? Vec{0, 0, 1} : to_point(pose.column_m[2]);
  return dot(a, cross(b, c));
}

void add_forces(const LinkageDevice& device, const device::Pose& pose, Workspace& to) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const double length_m = norm(to_point(pose.column_m[k]));
    // Worst is the direction of the column itself.
    const double largest_Nm = wide(device.limits.max_torque_Nm[k]);
    const double lasting_Nm =
        device.continuous_Nm[k] > 0 ? wide(device.continuous_Nm[k]) : largest_Nm;
    const auto lower = [&](double torque_Nm, double& least_N) {
      const double force_N = torque_Nm / length_m;
      if (!(least_N > 0) || force_N < least_N) least_N = force_N;
    };
    lower(largest_Nm, to.least_force_N);
    lower(lasting_Nm, to.lasting_force_N);
    to.count_m =
        std::max(to.count_m, length_m / std::fabs(wide(device.joints.joint[k].counts_per_rad)));
  }
}

JointMotion motion_at(const float (&angle_rad)[device::kMaxJoints]) {
  JointMotion at;
  for (uint32_t k = 0; k < device::kMaxJoints; ++k) at.angle_rad[k] = wide(angle_rad[k]);
  return at;
}

void add(const LinkageDevice& device, const float (&angle_rad)[device::kMaxJoints],
         Determinants& seen, Workspace& to) {
  const device::Pose pose = std::visit(
      [&](const auto& linkage) { return device::pose_of(linkage, angle_rad); }, device.linkage);
  ++to.poses;
  const double condition = wide(pose.reciprocal_condition);
  if (to.poses == 1 || condition < to.worst_condition) {
    to.worst_condition = condition;
    for (uint32_t k = 0; k < device::kMaxJoints; ++k) to.worst_at_rad[k] = wide(angle_rad[k]);
  }
  if (!pose.is_reachable) return;
  const Vec tip_m = to_point(pose.position_m);
  if (to.reachable++ == 0) to.low_m = to.high_m = tip_m;
  to.low_m = {std::min(to.low_m.x, tip_m.x), std::min(to.low_m.y, tip_m.y),
              std::min(to.low_m.z, tip_m.z)};
  to.high_m = {std::max(to.high_m.x, tip_m.x), std::max(to.high_m.y, tip_m.y),
               std::max(to.high_m.z, tip_m.z)};
  const double volume = determinant(pose, device.joints.joints);
  seen.positive = seen.positive || volume > 0;
  seen.negative = seen.negative || volume < 0;
  if (pose.reciprocal_condition >= device.limits.full_from) {
    ++to.with_whole_force;
    add_forces(device, pose, to);
    const tools::TipFigures tip = tools::tip_figures(device, motion_at(angle_rad));
    to.massless += tip.least_mass_kg > 0 ? 0u : 1u;
    if (tip.least_mass_kg > 0 &&
        (!(to.least_mass_kg > 0) || tip.least_mass_kg < to.least_mass_kg)) {
      to.least_mass_kg = tip.least_mass_kg;
      to.lightest_at = motion_at(angle_rad);
    }
  } else if (pose.reciprocal_condition > device.limits.gone_at) {
    ++to.with_faded_force;
  }
}

}  // namespace

Workspace workspace_of(const LinkageDevice& device, uint32_t steps) {
  Workspace to;
  Determinants seen;
  uint32_t last[device::kMaxJoints] = {};
  for (uint32_t k = 0; k < device.joints.joints; ++k) last[k] = steps;
  for (uint32_t i = 0; i <= last[0]; ++i)
    for (uint32_t j = 0; j <= last[1]; ++j)
      for (uint32_t l = 0; l <= last[2]; ++l) {
        const uint32_t at[] = {i, j, l};
        float angle_rad[device::kMaxJoints] = {};
        for (uint32_t k = 0; k < device.joints.joints; ++k) {
          const device::JointSetting& joint = device.joints.joint[k];
          angle_rad[k] = static_cast<float>(
              wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * at[k] / steps);
        }
        add(device, angle_rad, seen, to);
      }
  to.changes_orientation = seen.positive && seen.negative;
  return to;
}

// E (1 + 2 K T^2 / m) + q sqrt(2 K E) = 1 mJ, a quadratic equation for sqrt(K).
double stiffest_wall_N_per_m(const Workspace& workspace, double period_s) {
  constexpr double kMaxGain_J = 1e-3;
  const double reservoir_J = wide(params::kTable[params::kEnergyReservoir].initial);
  const double a = 2 * reservoir_J * period_s * period_s / workspace.least_mass_kg;
  const double b = workspace.count_m * std::sqrt(2 * reservoir_J), c = reservoir_J - kMaxGain_J;
  const double root = (std::sqrt(b * b - 4 * a * c) - b) / (2 * a);
  return root * root;
}

bool is_free_of_singularities(const Workspace& workspace) {
  return workspace.poses > 0 &&
         workspace.with_whole_force + workspace.with_faded_force == workspace.poses &&
         !workspace.changes_orientation;
}

}  // namespace firmtouch::host_sim
