#pragma once
#include "firmtouch/device/linkage.hpp"

/// A linkage of this project: a gantry whose two motors share a belt, one turning it by x + y and
/// one by x - y, with a screw for z.
struct CoreXY {
  float pulley_radius_m;
  float screw_m_per_rad;
};

firmtouch::device::Pose pose_of(const CoreXY& gantry, const float (&angle_rad)[3]);

/// The force that holds these torques: how the program checks what it renders.
void force_of(const CoreXY& gantry, const float (&torque_Nm)[3], float (&force_N)[3]);
