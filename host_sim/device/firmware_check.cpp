#include "host_sim/device/firmware_check.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "firmtouch/device/compensation.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kTriesAPose = 100;

double wide(float a) { return static_cast<double>(a); }

class Angles {
 public:
  explicit Angles(const LinkageDevice& device) : device_(device) {}
  JointMotion next() {
    JointMotion at;
    for (uint32_t k = 0; k < device_.joints.joints; ++k) {
      const device::JointSetting& joint = device_.joints.joint[k];
      at.angle_rad[k] =
          wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * share();
    }
    return at;
  }
  // From 0 to 1. The engine is the same everywhere, the library's distributions are not.
  double share() { return static_cast<double>(engine_()) / 4294967296.0; }

 private:
  const LinkageDevice& device_;
  std::mt19937 engine_{1};
};

void narrow(const JointMotion& at, float (&angle_rad)[kJoints]) {
  for (uint32_t k = 0; k < kJoints; ++k) angle_rad[k] = static_cast<float>(at.angle_rad[k]);
}

double inverse_error_m(const LinkageDevice& device, const device::StoredLinkage& linkage,
                       const JointMotion& at) {
  const Vec tip_m = points_of(device, at).tip.at_m;
  JointMotion found = at;
  for (double& angle : found.angle_rad) angle += 0.02;  // so that it is found, not copied
  if (!find_angles_from(device, tip_m, found)) return HUGE_VAL;
  float angle_rad[kJoints];
  narrow(found, angle_rad);
  return norm(tools::to_point(pose_of(linkage, angle_rad).position_m) - tip_m);
}

// Against central differences of the simulation's kinematics.
double jacobian_error(const LinkageDevice& device, const device::StoredLinkage& linkage,
                      const JointMotion& at) {
  constexpr double kStep_rad = 1e-5;  // leaves 1e-10 of the norm
  float angle_rad[kJoints];
  narrow(at, angle_rad);
  const device::Pose pose = pose_of(linkage, angle_rad);
  double off2 = 0, size2 = 0;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    JointMotion high = at, low = at;
    high.angle_rad[k] += kStep_rad, low.angle_rad[k] -= kStep_rad;
    const Vec moved_m = points_of(device, high).tip.at_m - points_of(device, low).tip.at_m;
    const Vec column_m = moved_m * (0.5 / kStep_rad);
    const Vec off_m = tools::to_point(pose.column_m[k]) - column_m;
    off2 += dot(off_m, off_m), size2 += dot(column_m, column_m);
  }
  return std::sqrt(off2 / size2);
}

double force_error(const device::StoredLinkage& linkage, const LinkageBody& body, Vec force_N) {
  device::JointState state;
  const device::Joints joints =
      read_joints(state, linkage.joints({device::Estimator::kDifference, 100}),
                  {{body.count(0), body.count(1), body.count(2)}, true, 0.001f});
  const device::Pose pose = pose_of(linkage, joints.angle_rad);
  const device::JointTorques out = torques(pose, linkage.limits(), tools::to_vec3(force_N));
  const Vec at_tip_N =
      body.tip_force_N({wide(out.torque_Nm[0]), wide(out.torque_Nm[1]), wide(out.torque_Nm[2])});
  const Vec wanted_N = force_N * wide(out.share);
  return norm(at_tip_N - wanted_N) / norm(wanted_N);
}

// The largest of the joints; `heaviest_Nm` is raised to the largest torque.
double weight_error_Nm(const device::StoredLinkage& linkage,
                       const device::Compensation& compensation, const LinkageBody& body,
                       double& heaviest_Nm) {
  float angle_rad[kJoints];
  narrow(body.motion(), angle_rad);
  math::Vec3 carried = carrying_torques_Nm(linkage, angle_rad, pose_of(linkage, angle_rad));
  if (compensation.is_open()) carried = carried - spring_torques_Nm(compensation, angle_rad);
  const double carried_Nm[] = {wide(carried.x), wide(carried.y), wide(carried.z)};
  double held_Nm[kJoints], error_Nm = 0;
  body.holding_torques_Nm(held_Nm);
  for (uint32_t k = 0; k < linkage.layout().joints; ++k) {
    heaviest_Nm = std::max(heaviest_Nm, std::fabs(held_Nm[k]));
    error_Nm = std::max(error_Nm, std::fabs(held_Nm[k] - carried_Nm[k]));
  }
  return error_Nm;
}

}  // namespace

FirmwareCheck check_firmware(const LinkageDevice& device, uint32_t poses) {
  const device::LinkageLayout layout = tools::layout_of(device);
  device::StoredLinkage linkage;
  FirmwareCheck check;
  if (!open(core::Bytes(reinterpret_cast<const uint8_t*>(&layout), sizeof layout), linkage).ok())
    return check;
  // Springs without a share that carries weight are not stored: as if it were there.
  LinkageDevice carried = device;
  carried.carried_share = std::max(device.carried_share, 0.1f);
  const std::vector<uint8_t> stored = tools::stored_bytes_of(carried);
  device::Compensation compensation;
  const core::Bytes section(stored.data(), static_cast<uint32_t>(stored.size()));
  if (!compensation.open(section, linkage).ok()) return check;
  Angles angles(device);
  double worst_Nm = 0;
  for (uint32_t tries = 0; check.poses < poses && tries < poses * kTriesAPose; ++tries) {
    const JointMotion at = angles.next();
    float angle_rad[kJoints];
    narrow(at, angle_rad);
    const float condition = pose_of(linkage, angle_rad).reciprocal_condition;
    if (!(condition >= layout.full_from)) continue;
    ++check.poses;
    const LinkageBody body(device, at);
    const Vec force_N{2 * angles.share() - 1, 2 * angles.share() - 1,
                      layout.joints == 2 ? 0 : 2 * angles.share() - 1};
    check.inverse_m = std::max(check.inverse_m, inverse_error_m(device, linkage, at));
    check.jacobian = std::max(check.jacobian, jacobian_error(device, linkage, at));
    const double force = force_error(linkage, body, force_N);
    check.force = std::max(check.force, force);
    if (force > kMaxForceError)
      check.force_condition = std::max(check.force_condition, wide(condition));
    worst_Nm = std::max(worst_Nm, weight_error_Nm(linkage, compensation, body, check.heaviest_Nm));
  }
  if (check.heaviest_Nm > 0) check.weight = worst_Nm / check.heaviest_Nm;
  return check;
}

bool is_good(const FirmwareCheck& check) {
  return check.poses > 0 && check.inverse_m <= kMaxInverse_m &&
         check.jacobian <= kMaxJacobianError && check.force <= kMaxForceError &&
         check.weight <= kMaxWeightError;
}

}  // namespace firmtouch::host_sim
