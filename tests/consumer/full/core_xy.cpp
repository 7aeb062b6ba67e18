#include "core_xy.hpp"

firmtouch::device::Pose pose_of(const CoreXY& gantry, const float (&angle_rad)[3]) {
  const float half_m = 0.5f * gantry.pulley_radius_m, screw_m = gantry.screw_m_per_rad;
  firmtouch::device::Pose pose;
  pose.position_m = {half_m * (angle_rad[0] + angle_rad[1]), half_m * (angle_rad[0] - angle_rad[1]),
                     screw_m * angle_rad[2]};
  pose.column_m[0] = {half_m, half_m, 0};
  pose.column_m[1] = {half_m, -half_m, 0};
  pose.column_m[2] = {0, 0, screw_m};
  pose.reciprocal_condition = firmtouch::device::reciprocal_condition(pose.column_m);
  pose.is_reachable = true;
  return pose;
}

void force_of(const CoreXY& gantry, const float (&torque_Nm)[3], float (&force_N)[3]) {
  force_N[0] = (torque_Nm[0] + torque_Nm[1]) / gantry.pulley_radius_m;
  force_N[1] = (torque_Nm[0] - torque_Nm[1]) / gantry.pulley_radius_m;
  force_N[2] = torque_Nm[2] / gantry.screw_m_per_rad;
}
