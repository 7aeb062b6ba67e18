#include "host_sim/device/drawn_links.hpp"

namespace firmtouch::host_sim {

LinkageDevice kinematics_of(const device::StoredLinkage& stored) {
  LinkageDevice device;
  switch (stored.layout().kind) {
    case device::kFiveBar:
      device.linkage = stored.five_bar();
      break;
    case device::kSerialArm:
      device.linkage = stored.serial_arm();
      break;
    default:
      device.linkage = stored.delta();
  }
  device.joints = stored.joints({device::Estimator::kDifference, 100});
  device.limits = stored.limits();
  return device;
}

std::vector<Vec> joints_m(const LinkageDevice& device, const JointMotion& at) {
  const MovingPoints points = points_of(device, at);
  std::vector<Vec> all;
  for (size_t chain = 0; chain < tools::links_of(device).size() / 2; ++chain) {
    all.push_back(points.base[chain].at_m);
    all.push_back(points.elbow[chain].at_m);
  }
  return all;
}

const JointMotion* TipFollower::at(Vec tip_m) {
  is_found_ = (is_found_ && find_angles_from(device_, tip_m, motion_)) ||
              find_angles(device_, tip_m, motion_);
  return is_found_ ? &motion_ : nullptr;
}

}  // namespace firmtouch::host_sim
