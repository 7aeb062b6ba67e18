#include <cmath>

#include "device/inertia.hpp"

namespace firmtouch::tools {
namespace {

using device::Delta;
using device::FiveBar;
using device::SerialArm;

std::vector<Link> links(const FiveBar& bar) {
  return {{"proximal", 0, wide(bar.proximal_m[0])},
          {"proximal", 1, wide(bar.proximal_m[1])},
          {"distal", 0, wide(bar.distal_m[0])},
          {"distal", 1, wide(bar.distal_m[1])}};
}
std::vector<Link> links(const SerialArm& arm) {
  return {{"link", 0, wide(arm.link_m[0])}, {"link", 1, wide(arm.link_m[1])}};
}
std::vector<Link> links(const Delta& delta) {
  std::vector<Link> all;
  for (int k = 0; k < 3; ++k) all.push_back({"upper", k, wide(delta.upper_m[k])});
  for (int k = 0; k < 3; ++k) all.push_back({"lower", k, wide(delta.lower_m[k])});
  return all;
}

template <size_t kCount>
void put(float (&to)[kCount], const float* from, uint32_t count) {
  for (uint32_t k = 0; k < count; ++k) to[k] = from[k];
}

// All except its lengths.
void put_linkage(const FiveBar& bar, device::LinkageLayout& to) {
  to.kind = device::kFiveBar;
  to.flags = bar.is_tip_left ? device::kFlagTip : 0;
  to.offset_m[0] = bar.base_m;
}
void put_linkage(const SerialArm& arm, device::LinkageLayout& to) {
  to.kind = device::kSerialArm;
  to.flags = arm.has_parallelogram ? device::kFlagParallelogram : 0;
  to.offset_m[0] = arm.offset_m;
  to.offset_m[1] = arm.height_m;
}
void put_linkage(const Delta& delta, device::LinkageLayout& to) {
  to.kind = device::kDelta;
  to.flags = delta.is_tip_above ? device::kFlagTip : 0;
  to.offset_m[0] = delta.base_radius_m;
  to.offset_m[1] = delta.platform_radius_m;
  to.offset_m[2] = delta.side_m;
}

template <class T>
void append(std::vector<uint8_t>& to, const T& layout) {
  const uint8_t* const bytes = reinterpret_cast<const uint8_t*>(&layout);
  to.insert(to.end(), bytes, bytes + sizeof layout);
}

}  // namespace

std::vector<Link> links_of(const LinkageDevice& device) {
  return std::visit([](const auto& linkage) { return links(linkage); }, device.linkage);
}

device::Load load_of(const LinkageDevice& device) {
  device::Load load;
  const std::vector<Link> all = links_of(device);
  // The first half are the driven links, of which one end is fixed; the others end at the tip.
  const size_t half = all.size() / 2;
  double elbow_kg[device::kMaxJoints] = {}, tip_kg = device.masses.tip_mass_kg;
  for (size_t i = 0; i < half; ++i) {
    const Rod &driven = device.masses.rod[i], &outer = device.masses.rod[half + i];
    const double far_share = outer.centre_m / all[half + i].length_m;
    elbow_kg[i] = driven.mass_kg * driven.centre_m / all[i].length_m;
    elbow_kg[i] += outer.mass_kg * (1 - far_share);
    tip_kg += outer.mass_kg * far_share;
  }
  for (size_t i = 0; i < half; ++i) load.elbow_mass_kg[i] = static_cast<float>(elbow_kg[i]);
  // Joint 0 of an arm carries the shoulder round, too, where it has an offset.
  const auto* const arm = std::get_if<SerialArm>(&device.linkage);
  if (arm != nullptr && arm->joints == 3 && std::fabs(arm->offset_m) > 0.0f) {
    const Rod& upper = device.masses.rod[0];
    load.elbow_mass_kg[1] =
        static_cast<float>(upper.mass_kg * (1 - upper.centre_m / all[0].length_m));
  }
  load.tip_mass_kg = static_cast<float>(tip_kg);
  load.gravity_mps2 = to_vec3(device.masses.gravity_mps2);
  return load;
}

device::LinkageLayout layout_of(const LinkageDevice& device) {
  device::LinkageLayout to = {};
  std::visit([&](const auto& linkage) { put_linkage(linkage, to); }, device.linkage);
  float* length_m = to.length_m;
  for (const Link& link : links_of(device)) *length_m++ = static_cast<float>(link.length_m);
  if (device.are_walls_forced) to.flags |= device::kFlagForcedWalls;
  to.least_mass_kg = static_cast<float>(least_figures(device).least_mass_kg);
  to.joints = device.joints.joints;
  for (uint32_t k = 0; k < to.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    to.joint[k] = {joint.counts_per_rad, joint.zero_rad, joint.low_rad, joint.high_rad};
  }
  put(to.max_torque_Nm, device.limits.max_torque_Nm, to.joints);
  to.torque_rise_s = device.torque_rise_s;
  to.max_speed_rad_per_s = device.joints.max_speed_rad_per_s;
  to.full_from = device.limits.full_from;
  to.gone_at = device.limits.gone_at;
  const device::Load load = load_of(device);
  put(to.elbow_mass_kg, load.elbow_mass_kg, 3);
  to.tip_mass_kg = load.tip_mass_kg;
  to.gravity_mps2[0] = load.gravity_mps2.x;
  to.gravity_mps2[1] = load.gravity_mps2.y;
  to.gravity_mps2[2] = load.gravity_mps2.z;
  to.carried_share = device.carried_share;
  return to;
}

bool has_compensation(const LinkageDevice& device) {
  if (!(device.carried_share > 0)) return false;
  for (const JointFriction& joint : device.masses.joint)
    if (joint.spring_N_m_per_rad > 0) return true;
  return device.friction_share > 0;
}

std::vector<uint8_t> stored_bytes_of(const LinkageDevice& device) {
  std::vector<uint8_t> bytes;
  append(bytes, layout_of(device));
  if (device.is_homed) {
    device::HomingLayout homing = {};
    homing.by = static_cast<uint32_t>(device.homing.by);
    homing.speed_rad_per_s = device.homing.speed_rad_per_s;
    homing.margin_rad = device.homing.margin_rad;
    put(homing.torque_Nm, device.homing.torque_Nm, device.joints.joints);
    put(homing.pose_rad, device.homing.pose_rad, device.joints.joints);
    append(bytes, homing);
  }
  if (device.has_index_pulses) {
    device::IndexLayout index = {};
    put(index.index_rad, device.homing.index_rad, device.joints.joints);
    put(index.period_rad, device.homing.index_period_rad, device.joints.joints);
    index.within_rad = device.homing.index_within_rad;
    append(bytes, index);
  }
  if (device.has_second_encoders) {
    device::SecondEncodersLayout second = {};
    put(second.counts_per_rad, device.second_counts_per_rad, device.joints.joints);
    second.within_rad = device.second_within_rad;
    append(bytes, second);
  }
  if (device.is_derated) {
    device::DeratingLayout derating = {};
    put(derating.continuous_Nm, device.continuous_Nm, device.joints.joints);
    put(derating.time_s, device.thermal_time_s, device.joints.joints);
    append(bytes, derating);
  }
  if (has_compensation(device)) {
    device::CompensationLayout compensation = {};
    compensation.tag = device::kCompensationTag;
    for (uint32_t k = 0; k < device.joints.joints; ++k) {
      const JointFriction& joint = device.masses.joint[k];
      compensation.spring_Nm_per_rad[k] = static_cast<float>(joint.spring_N_m_per_rad);
      compensation.relaxed_rad[k] = static_cast<float>(joint.relaxed_rad);
      if (device.friction_share > 0)
        compensation.friction_Nm[k] = static_cast<float>(joint.coulomb_N_m);
    }
    compensation.friction_share = device.friction_share;
    if (device.friction_share > 0)
      compensation.friction_fade_rad_per_s = device.friction_fade_rad_per_s;
    append(bytes, compensation);
  }
  return bytes;
}

}  // namespace firmtouch::tools
